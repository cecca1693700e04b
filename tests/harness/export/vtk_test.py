"""Reads exported modes and a motion with VTK's own readers. Arguments: the program and a separate folder. The exit
status is 77 if VTK is not installed."""
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

try:
    import vtk
except ImportError:
    print("skipped: no module vtk")
    sys.exit(77)

program, folder = sys.argv[1], Path(sys.argv[2])


def grids(case, kind):
    """Yields the time and the grid of each data set of a case."""
    subprocess.run([program, "run", case, "--variant", "base", "--vtk", "--out", folder], stdout=subprocess.DEVNULL)
    name = folder / "vtk" / f"{case}-base-{kind}.pvd"
    for one in xml.etree.ElementTree.parse(name).getroot().findall("Collection/DataSet"):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(name.parent / one.get("file")))
        reader.Update()
        yield float(one.get("timestep")), reader.GetOutput()


modes = list(grids("manipulator-modes", "shapes"))
assert len(modes) == 6, len(modes)
for _, grid in modes:
    moved = grid.GetPointData().GetVectors()
    assert grid.GetNumberOfCells() > 20 and moved.GetNumberOfTuples() == grid.GetNumberOfPoints() > 20
    assert moved.GetName() == "displacement" and moved.GetMaxNorm() > 0
    low, high, *_ = grid.GetBounds()
    assert 0.3 < high - low < 0.7, grid.GetBounds()  # extent of the drawing, near the base side of 0.5 m

motion = list(grids("elastodynamics-circle", "motion"))
times = [time for time, _ in motion]
assert len(motion) > 20 and times == sorted(set(times)) and times[0] == 0 and 6.2 < times[-1] < 6.4, times
largest = [grid.GetPointData().GetVectors().GetMaxNorm() for _, grid in motion]
assert 1e-3 < max(largest) < 0.05, largest
centers = {grid.GetPoint(9) for _, grid in motion}
assert len(centers) == len(motion)  # P is at a different position at each time

"""Modes of a case and a motion read by VTK's own readers. Arguments: the program and a folder of its own. Exit
status 77 where there is no VTK."""
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
    """Time and grid of each set of a case."""
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
    assert 0.3 < high - low < 0.7, grid.GetBounds()  # the base's side is 0.5 m

motion = list(grids("elastodynamics-circle", "motion"))
times = [time for time, _ in motion]
assert len(motion) > 20 and times == sorted(set(times)) and times[0] == 0 and 6.2 < times[-1] < 6.4, times
largest = [grid.GetPointData().GetVectors().GetMaxNorm() for _, grid in motion]
assert 1e-3 < max(largest) < 0.05, largest
centres = {grid.GetPoint(9) for _, grid in motion}
assert len(centres) == len(motion)  # P goes round

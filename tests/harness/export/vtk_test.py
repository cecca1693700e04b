"""Modes of a case read by VTK's own readers. Arguments: the program and a folder of its own. Exit
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
subprocess.run([program, "run", "manipulator-modes", "--variant", "base", "--vtk", "--out", folder], check=True, stdout=subprocess.DEVNULL)
name = folder / "vtk" / "manipulator-modes-base-shapes.pvd"
sets = xml.etree.ElementTree.parse(name).getroot().findall("Collection/DataSet")
assert len(sets) == 6, len(sets)
for one in sets:
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(name.parent / one.get("file")))
    reader.Update()
    grid = reader.GetOutput()
    moved = grid.GetPointData().GetVectors()
    assert grid.GetNumberOfCells() > 20 and moved.GetNumberOfTuples() == grid.GetNumberOfPoints() > 20
    assert moved.GetName() == "displacement" and moved.GetMaxNorm() > 0, one.get("file")
    low, high, *_ = grid.GetBounds()
    assert 0.3 < high - low < 0.7, grid.GetBounds()  # the base's side is 0.5 m

#!/usr/bin/env bash
# VTK's reader of Exodus files moves the points by the first vector at nodes whose name begins with the letters "dis", whatever
# their case: by disp_x, disp_y, disp_z as meant, but as well by discharge_x, discharge_y, discharge_z, or by a distance. It
# does so too when that field is not among those to be read, and it then says nothing of it. Displacements that begin with
# another letter, u_x or wall_displacement_x, leave the points where they are.
# A guess would be the name disp or displacement, or that somebody has to ask for it; and that a field that is not read does
# nothing. SetApplyDisplacements(0) gives the file's points.
# Seen with VTK 9.1.0 (Debian 12). Each vector is (10, 20, 30) at all nodes; the first node is at (0, 0, 0).
# Output seen: disp and Discharge (10, 20, 30), also unread; u and wall_displacement (0, 0, 0).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 python3-netcdf4=1.6.2-1+b1
cat >"$scratch/12/root/moves.py" <<'END'
import netCDF4, numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader


def write(vector):
    """One tetrahedron with three fields at nodes, which VTK takes for one vector."""
    with netCDF4.Dataset("/root/one.e", "w", format="NETCDF3_64BIT_OFFSET") as file:
        file.setncatts({"version": numpy.float32(5.1), "api_version": numpy.float32(5.1),
                        "floating_point_word_size": numpy.int32(8), "file_size": numpy.int32(1)})
        for name, size in (("len_string", 33), ("len_line", 81), ("len_name", 33), ("four", 4), ("time_step", None),
                           ("num_dim", 3), ("num_nodes", 4), ("num_elem", 1), ("num_el_blk", 1), ("num_el_in_blk1", 1),
                           ("num_nod_per_el1", 4), ("num_nod_var", 3)):
            file.createDimension(name, size)
        for letter, values in (("x", [0, 1, 0, 0]), ("y", [0, 0, 1, 0]), ("z", [0, 0, 0, 1])):
            file.createVariable("coord" + letter, "f8", ("num_nodes",))[:] = values
        file.createVariable("eb_status", "i4", ("num_el_blk",))[:] = 1
        file.createVariable("eb_prop1", "i4", ("num_el_blk",))[:] = 1
        file["eb_prop1"].setncattr("name", "ID")
        file.createVariable("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1"))[:] = [[1, 2, 3, 4]]
        file["connect1"].elem_type = "TETRA"
        file.createVariable("time_whole", "f8", ("time_step",))[:] = 0.0
        file.createVariable("name_nod_var", "S1", ("num_nod_var", "len_name"))
        for n, letter in enumerate("xyz"):
            file["name_nod_var"][n, :] = numpy.array(list(f"{vector}_{letter}".ljust(33, "\0")), dtype="S1")
            file.createVariable(f"vals_nod_var{n + 1}", "f8", ("time_step", "num_nodes"))[0, :] = 10 * n + 10


def first_point(read_it):
    reader = vtkExodusIIReader()
    reader.SetFileName("/root/one.e")
    reader.UpdateInformation()
    reader.SetPointResultArrayStatus(reader.GetPointResultArrayName(0), read_it)
    reader.Update()
    return reader.GetOutput().GetBlock(0).GetBlock(0).GetPoint(0)


for vector in ("disp", "Discharge", "u", "wall_displacement"):
    write(vector)
    print(f"{vector}: {first_point(1)}, unread: {first_point(0)}")
END
within "$scratch/12" python3 -W ignore /root/moves.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "where the first point is"
disp: (10.0, 20.0, 30.0), unread: (10.0, 20.0, 30.0)
Discharge: (10.0, 20.0, 30.0), unread: (10.0, 20.0, 30.0)
u: (0.0, 0.0, 0.0), unread: (0.0, 0.0, 0.0)
wall_displacement: (0.0, 0.0, 0.0), unread: (0.0, 0.0, 0.0)
END

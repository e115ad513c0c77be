#!/usr/bin/env bash
# meshio reads meshes of Exodus II without their side sets and without the names of their blocks, and says nothing. Node sets are
# read. A guess would be that named surfaces, which Cubit and libMesh write as side sets, arrive as sets of cells.
# The same in 5.0.0 (Debian 12) and 5.3.5 (Debian 13). VTK 9.2 lists the block and the side set of the same file by their names.
# Output seen: "5.0.0: 1 tetra, sets of cells {}, of points {}, other data {} {}", and 5.3.5 the same.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-meshio=7.0.0-3 python3-netcdf4=1.6.2-1+b1
debian trixie "$scratch/13" python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-netcdf4=1.7.2-1+b4

# One tetrahedron in a block "wall", one of its sides in a side set "inner".
cat >"$scratch/write.py" <<'END'
import netCDF4, numpy

with netCDF4.Dataset("/root/one.e", "w", format="NETCDF3_64BIT_OFFSET") as file:
    file.setncatts({"title": "one", "version": numpy.float32(5.1), "api_version": numpy.float32(5.1),
                    "floating_point_word_size": numpy.int32(8), "file_size": numpy.int32(1)})
    for name, size in (("len_string", 33), ("len_line", 81), ("len_name", 33), ("four", 4), ("time_step", None), ("num_dim", 3),
                       ("num_nodes", 4), ("num_elem", 1), ("num_el_blk", 1), ("num_el_in_blk1", 1), ("num_nod_per_el1", 4),
                       ("num_side_sets", 1), ("num_side_ss1", 1)):
        file.createDimension(name, size)

    def whole(name, dimensions, values):
        file.createVariable(name, "i4", dimensions)[:] = values
        return file[name]

    def word(name, dimension, text):
        file.createVariable(name, "S1", (dimension, "len_name"))[0, :] = numpy.array(list(text.ljust(33, "\0")), dtype="S1")

    for letter, values in (("x", [0, 1, 0, 0]), ("y", [0, 0, 1, 0]), ("z", [0, 0, 0, 1])):
        file.createVariable("coord" + letter, "f8", ("num_nodes",))[:] = values
    whole("eb_status", ("num_el_blk",), 1)
    whole("eb_prop1", ("num_el_blk",), 1).setncattr("name", "ID")
    word("eb_names", "num_el_blk", "wall")
    whole("connect1", ("num_el_in_blk1", "num_nod_per_el1"), [[1, 2, 3, 4]]).elem_type = "TETRA"
    whole("ss_status", ("num_side_sets",), 1)
    whole("ss_prop1", ("num_side_sets",), 7).setncattr("name", "ID")
    word("ss_names", "num_side_sets", "inner")
    whole("elem_ss1", ("num_side_ss1",), 1)
    whole("side_ss1", ("num_side_ss1",), 4)
END
cat >"$scratch/read.py" <<'END'
import meshio
mesh = meshio.read("/root/one.e")
print(f"{meshio.__version__}: {len(mesh.cells[0].data)} {mesh.cells[0].type}, sets of cells {mesh.cell_sets}, of points "
      f"{mesh.point_sets}, other data {mesh.cell_data} {mesh.field_data}")
END
for version in 12:5.0.0 13:5.3.5; do
  place=$scratch/${version%:*}
  cp "$scratch"/*.py "$place/root/"
  within "$place" python3 -W ignore /root/write.py
  said=$(within "$place" python3 -W ignore /root/read.py 2>&1)
  echo "$said"
  [ "$said" = "${version#*:}: 1 tetra, sets of cells {}, of points {}, other data {} {}" ] || fail "$said"
done

"""Writes surfaces of VTK's XML format in each of the encodings that programs use."""

import base64
import struct
import zlib

import numpy as np


def vtp_array(kind, values, form):
    data = np.ascontiguousarray(values, dtype=kind)
    names = {"f8": "Float64", "i8": "Int64"}
    head = f'<DataArray type="{names[kind]}" NumberOfComponents="{data.shape[1] if data.ndim > 1 else 1}"'
    if form == "ascii":
        text = " ".join(map(repr, data.ravel().tolist()))
    elif form == "binary":
        text = base64.b64encode(struct.pack("<I", data.nbytes) + data.tobytes()).decode()
    else:
        packed = zlib.compress(data.tobytes())
        text = base64.b64encode(struct.pack("<4I", 1, data.nbytes, data.nbytes, len(packed))).decode()
        text += base64.b64encode(packed).decode()
    return head, form, text


def write_vtp(path, nodes, triangles, form, **fields):
    """form: ascii, binary, zlib, or raw, which is appended."""
    appended = b""

    def element(name, kind, values):
        nonlocal appended
        head, _, text = vtp_array(kind, values, "binary" if form == "raw" else form)
        if form != "raw":
            return f'{head} Name="{name}" format="{"ascii" if form == "ascii" else "binary"}">{text}</DataArray>'
        offset = len(appended)
        appended += base64.b64decode(text)
        return f'{head} Name="{name}" format="appended" offset="{offset}"/>'

    body = f'<Piece NumberOfPoints="{len(nodes)}" NumberOfPolys="{len(triangles)}"><PointData>'
    body += "".join(element(name, "f8", values) for name, values in fields.items())
    body += f'</PointData><Points>{element("Points", "f8", nodes)}</Points><Polys>'
    body += element("connectivity", "i8", triangles.ravel())
    body += element("offsets", "i8", 3 * np.arange(1, len(triangles) + 1)) + "</Polys></Piece>"
    packing = ' compressor="vtkZLibDataCompressor"' if form == "zlib" else ""
    text = (
        f'<VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt32"{packing}><PolyData>{body}</PolyData>'
    )
    tail = b'<AppendedData encoding="raw">_' + appended + b"</AppendedData>" if form == "raw" else b""
    path.write_bytes(text.encode() + tail + b"</VTKFile>")

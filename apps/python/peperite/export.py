"""Writes the snapshots of a run as VTK's PolyData, which ParaView and OVITO open.

    export DIR [--out FOLDER] [--from T] [--to T] [--every N] [--fields NAME,NAME,...]

particles_<step>.vtp: one vertex a particle with all its fields; contacts_<step>.vtp, where snapshots have contacts: one line each;
particles.pvd and contacts.pvd: the times. Written into DIR/vtk, or into FOLDER. Vectors and places have three components, tensors
nine by rows.
"""

import argparse
import base64
import re
import sys
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .contacts import Contacts
from .drawing.command import Parser, folder, refusing
from .errors import Error
from .run import Run

TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "u8": "UInt64", "i4": "Int32", "u4": "UInt32", "u1": "UInt8"}
BLOCK = 1 << 20  # bytes that are compressed as one
ROWS = {2: (0, 2, None, 2, 1, None, None, None, None), 3: (0, 3, 4, 3, 1, 5, 4, 5, 2)}  # of a tensor, in its components


def encoded(values):
    """Base64 of a header and of compressed blocks, as VTK reads them."""
    data = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<")).tobytes()
    blocks = [data[k:k + BLOCK] for k in range(0, len(data), BLOCK)]
    packed = [zlib.compress(block, 1) for block in blocks]
    rest = len(data) % BLOCK
    header = np.array([len(blocks), BLOCK, rest, *map(len, packed)], dtype="<u8").tobytes()
    return (base64.b64encode(header) + base64.b64encode(b"".join(packed))).decode()


def add(parent, name, values):
    values = np.asarray(values)
    kind = values.dtype.str[1:]
    if kind not in TYPES:
        raise Error(f"{name}: VTK has no numbers of the type {values.dtype}")
    size = str(values.shape[1] if values.ndim == 2 else 1)
    ElementTree.SubElement(parent, "DataArray", type=TYPES[kind], Name=name, NumberOfComponents=size, format="binary").text = encoded(values)


def in_space(values):
    """Places and vectors of two dimensions at z = 0."""
    return values if values.shape[1] == 3 else np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def as_vtk(snapshot, field):
    values = snapshot[field]
    if values.ndim == 1:
        return values
    dim = snapshot.scene["dimension"]
    if values.shape[1] == dim:
        return in_space(values)
    if values.shape[1] != {2: 3, 3: 6}.get(dim):
        return values
    names = "xx yy xy" if dim == 2 else "xx yy zz xy xz yz"
    parts = [snapshot.component(field, name) for name in names.split()]
    return np.stack([np.zeros(len(values)) if k is None else parts[k] for k in ROWS[dim]], axis=1)


def poly_data(time, points, cells, kind):
    """A file's tree and the place of its data, one row a cell; `kind` Verts or Lines."""
    root = ElementTree.Element("VTKFile", type="PolyData", version="1.0", byte_order="LittleEndian", header_type="UInt64",
                               compressor="vtkZLibDataCompressor")
    data = ElementTree.SubElement(root, "PolyData")
    add(ElementTree.SubElement(data, "FieldData"), "TimeValue", np.array([time]))
    data[0][0].set("NumberOfTuples", "1")
    piece = ElementTree.SubElement(data, "Piece", NumberOfPoints=str(len(points)), **{f"NumberOf{kind}": str(len(cells))})
    add(ElementTree.SubElement(piece, "Points"), "Points", points)
    of_cells = ElementTree.SubElement(piece, kind)
    add(of_cells, "connectivity", cells.ravel())
    add(of_cells, "offsets", cells.shape[1] * np.arange(1, len(cells) + 1, dtype=np.int64))
    return root, piece


def particles(snapshot, fields):
    points = in_space(snapshot["position"])
    root, piece = poly_data(snapshot.time, points, np.arange(len(points), dtype=np.int64)[:, None], "Verts")
    data = ElementTree.SubElement(piece, "PointData")
    for field in fields or snapshot.fields:
        if field != "position":
            add(data, field, as_vtk(snapshot, field))
    return root


def contacts(snapshot):
    """From the first grain to the point of contact and on to the second, where there is one."""
    all_ = Contacts(snapshot)
    start = in_space(snapshot["position"])[all_.first]
    to_point = snapshot.nearest_image(all_.point - start)
    end = np.where(all_.second[:, None] < 0, to_point,
                   snapshot.nearest_image(snapshot["position"][all_.second] - start))
    points = np.concatenate([start, start + end])
    n = len(start)
    root, piece = poly_data(snapshot.time, points, np.stack([np.arange(n), np.arange(n) + n], axis=1), "Lines")
    data = ElementTree.SubElement(piece, "CellData")
    normal = np.einsum("ka,ka->k", all_.force, all_.normal)
    add(data, "force", all_.force)
    add(data, "normal_force", -normal)
    add(data, "first_id", snapshot["id"][all_.first])
    add(data, "with_wall", (all_.second < 0).astype(np.uint8))
    return root


def write_index(path, files, source):
    root = ElementTree.Element("VTKFile", type="Collection", version="1.0", byte_order="LittleEndian", run=source)
    collection = ElementTree.SubElement(root, "Collection")
    for time, name in files:
        ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=name)
    ElementTree.ElementTree(root).write(path)


def refuse_files_of_others(out, source):
    """Only what was exported of this run is overwritten."""
    try:
        if ElementTree.parse(out / "particles.pvd").getroot().get("run") == source:
            return
    except (OSError, ElementTree.ParseError):
        pass
    for path in sorted(out.glob("*")):
        if re.fullmatch(r"(particles|contacts)(_\d+\.vtp|\.pvd)", path.name):
            raise Error(f"{path} is there already, and not of this run: choose another --out")


def export(run, out=None, begin=None, end=None, every=1, fields=()):
    """Writes the files, and yields their paths."""
    source = str(run.folder.resolve())
    chosen = [k for k, t in enumerate(run.times) if (begin is None or t >= begin) and (end is None or t <= end)][::every]
    if not chosen:
        raise Error(f"{run.folder}: no snapshot between these times")
    for field in fields:
        run[chosen[0]][field]  # refused before there is anything
    if out is not None:
        refuse_files_of_others(Path(out), source)
    out = Path(out) if out is not None else run.folder / "vtk"
    out.mkdir(parents=True, exist_ok=True)
    write_index(out / "particles.pvd", [], source)  # so that one that is interrupted is known
    index = {"particles": [], "contacts": []}
    for snapshot in (run[k] for k in chosen):
        for kind, make in (("particles", lambda: particles(snapshot, fields)), ("contacts", lambda: contacts(snapshot))):
            if kind == "contacts" and not snapshot.has_contacts():
                continue
            name = f"{kind}_{snapshot.step:09}.vtp"
            ElementTree.ElementTree(make()).write(out / name)
            index[kind].append((snapshot.time, name))
            yield out / name
    for kind, files in index.items():
        if files:
            write_index(out / f"{kind}.pvd", files, source)
            yield out / f"{kind}.pvd"


def main():
    parser = Parser(prog="peperite export", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", metavar="DIR")
    parser.add_argument("--out", metavar="FOLDER", type=folder)
    parser.add_argument("--from", metavar="T", dest="begin", type=float, help="snapshots from this time on [s]")
    parser.add_argument("--to", metavar="T", dest="end", type=float, help="... up to this time [s]")
    parser.add_argument("--every", metavar="N", type=int, default=1, help="of those each N-th")
    parser.add_argument("--fields", metavar="NAME,...", type=lambda text: tuple(text.split(",")), default=(), help="instead of all")
    given = parser.parse_args(sys.argv[1:])
    if given.every < 1:
        parser.error("--every: must be at least 1")
    for path in export(Run(given.run), given.out, given.begin, given.end, given.every, given.fields):
        print(path)


if __name__ == "__main__":
    sys.exit(refusing(main))

"""Start files as another program would write them: ids of any kind, rows in any order, CSV or HDF5."""

MOST_ID = 2**63 - 1  # those above are refused


def ids(d, count):
    most = 2**64 - 2 if d.chance("beyond", 0.03) else MOST_ID
    kind = d.weighted("ids", {"plain": 3, "permuted": 2, "sparse": 2, "huge": 2, "half": 1, "mixed": 1})
    if kind == "plain":
        return list(range(count))
    if kind == "permuted":
        return d.shuffled("order of ids", range(count))
    if kind == "sparse":
        return [7 + 1000003 * k for k in d.shuffled("order of ids", range(count))]
    if kind == "huge":
        return [most - k for k in d.shuffled("order of ids", range(count))]
    if kind == "half":
        return [min(2**63, most - count) - 5 + k for k in d.shuffled("order of ids", range(count))]
    spread = [d.whole(f"id/{k}", 0, most >> d.whole(f"bits/{k}", 0, 62)) for k in range(count)]
    return [x if spread.index(x) == k else most - k for k, x in enumerate(spread)] if count < 400 else list(range(count))


def csv(rows):
    """Rows are dicts of the same keys."""
    lines = [",".join(rows[0])] if rows else []
    return "\n".join(lines + [",".join(v if isinstance(v, str) else repr(v) for v in row.values()) for row in rows]) + "\n"


def write_hdf5(path, rows, groups, dim):
    import h5py
    import numpy

    axes = "xyz"[:dim]
    with h5py.File(path, "w") as file:
        file["id"] = numpy.array([r["id"] for r in rows], dtype="u8")
        file["x"] = numpy.array([[r[a] for a in axes] for r in rows])
        file["v"] = numpy.array([[r["v" + a] for a in axes] for r in rows])
        file["group"] = numpy.array([groups.index(r["group"]) for r in rows], dtype="u4")
        for key in ("rho", "m", "u", "mass", "radius"):
            if key in rows[0]:
                file[key] = numpy.array([r[key] for r in rows])
        if "wx" in rows[0]:
            file["spin"] = numpy.array([[r["w" + a] for a in axes] for r in rows])

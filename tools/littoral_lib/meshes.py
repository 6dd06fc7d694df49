"""Triangles and lines as files that ParaView, Blender and CAD programs read (VTP, PLY, STL), and as pictures."""

import base64

import numpy as np

MOST_DRAWN = 40000  # triangles of a picture: matplotlib sorts them one by one


def corners(x, faces):
    return x[faces]  # (m, 3, 3)


def normals(x, faces):
    """Of the triangles, not normalised: twice their area long."""
    a, b, c = np.moveaxis(corners(x, faces), 1, 0)
    return np.cross(b - a, c - a)


def area(x, faces):
    return 0.5 * float(np.linalg.norm(normals(x, faces), axis=1).sum())


def write_triangles(stem, x, faces):
    """stem.vtp, .ply, .stl; returns the paths."""
    vtp, ply, stl = (stem.with_suffix(s) for s in (".vtp", ".ply", ".stl"))
    write_vtp(vtp, x, "Polys", faces.ravel(), 3 * np.arange(1, len(faces) + 1))
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(x)}\nproperty float x\nproperty float y\n"
              f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    rows = np.empty(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    ply.write_bytes(header.encode() + x.astype("<f4").tobytes() + rows.tobytes())
    record = np.zeros(len(faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    n = normals(x, faces)
    record["normal"] = n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
    record["corners"] = corners(x, faces)
    stl.write_bytes(b"littoral free surface".ljust(80) + np.uint32(len(faces)).tobytes() + record.tobytes())
    return [vtp, ply, stl]


def write_lines(stem, polylines):
    """stem.vtp of lines in the plane y = 0; returns the paths."""
    points = np.concatenate(polylines) if polylines else np.zeros((0, 2))
    x = np.stack([points[:, 0], np.zeros(len(points)), points[:, 1]], axis=1)
    vtp = stem.with_suffix(".vtp")
    write_vtp(vtp, x, "Lines", np.arange(len(x)), np.cumsum([len(p) for p in polylines]))
    return [vtp]


def write_vtp(path, x, kind, connectivity, offsets):
    """VTK PolyData, binary arrays within the XML."""
    def array(values, kind_of, name="", components=1):
        data = np.ascontiguousarray(values).tobytes()
        text = base64.b64encode(np.uint64(len(data)).tobytes()).decode() + base64.b64encode(data).decode()
        return (f'<DataArray type="{kind_of}" Name="{name}" NumberOfComponents="{components}" format="binary">'
                f"{text}</DataArray>\n")

    counts = {k: 0 for k in ("Verts", "Lines", "Strips", "Polys")} | {kind: len(offsets)}
    numbers = " ".join(f'NumberOf{k}="{n}"' for k, n in counts.items())
    path.write_text('<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<PolyData>'
                    f'<Piece NumberOfPoints="{len(x)}" {numbers}>\n<Points>'
                    + array(np.asarray(x, "<f4"), "Float32", "Points", 3) + f"</Points>\n<{kind}>"
                    + array(np.asarray(connectivity, "<i8"), "Int64", "connectivity")
                    + array(np.asarray(offsets, "<i8"), "Int64", "offsets")
                    + f"</{kind}>\n</Piece></PolyData>\n</VTKFile>\n", encoding="ascii")


def draw_lines(path, polylines, time):
    from .plotting import pyplot
    plt = pyplot()
    figure, axes = plt.subplots(figsize=(9, 5))
    for line in polylines:
        axes.plot(line[:, 0], line[:, 1], color="#1f77b4", lw=1)
    axes.set(xlabel="x [m]", ylabel="z [m]", title=f"free surface, t = {time:.4g} s")
    axes.set_aspect("equal")
    figure.savefig(path)
    plt.close(figure)


def draw_triangles(path, x, faces, time):
    """Seen from the front above, shaded by their slope towards the light."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    from .plotting import pyplot
    plt = pyplot()
    every = max(1, len(faces) // MOST_DRAWN)
    shown = faces[::every]
    n = normals(x, shown)
    n /= np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
    light = np.clip(n @ np.array([-0.4, -0.5, 0.77]), 0, 1)
    colours = np.array([0.12, 0.45, 0.7]) * (0.35 + 0.5 * light[:, None]) + 0.25 * light[:, None] ** 8
    figure = plt.figure(figsize=(9, 6))
    axes = figure.add_subplot(projection="3d")
    axes.add_collection3d(Poly3DCollection(x[shown], facecolors=np.clip(colours, 0, 1), linewidths=0))
    low, high = x.min(axis=0), x.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), xlabel="x [m]", ylabel="y [m]",
             zlabel="z [m]", title=f"free surface, t = {time:.4g} s")
    axes.set_box_aspect(np.maximum(high - low, 1e-3 * (high - low).max()))
    axes.view_init(25, -60)
    figure.savefig(path)
    plt.close(figure)

"""Meshes of grids of points."""

import numpy

from celltrace._celltrace import Mesh


def surface(x, y, z, *, smooth=True, values=None, colour_map=None, value_range=None, colours=None, uv=None):
    """A Mesh of a grid of points, of three arrays of (rows, columns); x and y may be lines, as numpy.meshgrid takes them.

    Points are where x, y and z say; faces with a corner that is not a number are left out. smooth: its normals are
    means of those of the faces around. Further keywords are those of Mesh, of arrays in the grid's shape; uv is 0 to 1
    along columns and rows if nothing else is said.
    """
    x, y, z = (numpy.asarray(part, float) for part in (x, y, z))
    if x.ndim == 1 and y.ndim == 1:
        x, y = numpy.meshgrid(x, y)
    if z.ndim != 2 or x.shape != z.shape or y.shape != z.shape or min(z.shape) < 2:
        raise ValueError(f"surface: x, y and z have to be grids of one shape, and are {x.shape}, {y.shape} and {z.shape}")
    rows, columns = z.shape
    vertices = numpy.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = numpy.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]))
    triangles = numpy.concatenate([numpy.stack([a, b, c], axis=-1), numpy.stack([a, c, d], axis=-1)])
    triangles = triangles[numpy.isfinite(vertices[triangles]).all(axis=(1, 2))]
    if uv is None and values is None:
        uv = numpy.stack(numpy.meshgrid(numpy.linspace(0, 1, columns), numpy.linspace(0, 1, rows)), axis=-1)
    return Mesh(vertices, triangles, normals=_normals(vertices, triangles) if smooth else None,
                values=None if values is None else numpy.asarray(values).ravel(), colour_map=colour_map,
                value_range=value_range, colours=None if colours is None else numpy.reshape(colours, (-1, 3)),
                uv=None if uv is None else numpy.reshape(uv, (-1, 2)), skip_nan=True)


def _normals(vertices, triangles):
    """Sums of the normals of the faces around each vertex, by their areas."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    of_faces = numpy.cross(b - a, c - a)
    sums = numpy.zeros_like(vertices)
    for i in range(3):
        for axis in range(3):
            sums[:, axis] += numpy.bincount(triangles[:, i], of_faces[:, axis], len(vertices))
    lengths = numpy.linalg.norm(sums, axis=1, keepdims=True)
    return numpy.divide(sums, lengths, out=numpy.tile([0.0, 1.0, 0.0], (len(vertices), 1)), where=lengths > 0)

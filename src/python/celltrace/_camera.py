"""Cameras that see all of something."""

import numpy

from celltrace import _celltrace


def fit(what, direction=(0, -1, 2), angle=40, *, sky=(0, 1, 0), aspect=1, margin=1.05, kind="perspective",
        right_handed=False):
    """A camera that sees all of a Scene, a Mesh or an array of points (n, 3), whatever shape the picture has.

    direction: the way it looks; angle: of its view, in degrees, the smaller one of a picture's width and height;
    sky: what is up; aspect: width by height of the pictures that it fills best; margin: how much wider the view is than what it has to show; kind: perspective, or orthographic,
    for which angle means nothing; right_handed: the axes are those of mathematics, as matplotlib's, and not POV-Ray's.
    Planes and other things without an end do not count.
    """
    if isinstance(what, _celltrace.Scene):
        points = _celltrace._points(what)
    elif isinstance(what, _celltrace.Mesh):
        points = what.vertices[numpy.unique(what.triangles)].astype(float)
    else:
        points = numpy.asarray(what, float)
        if points.ndim != 2 or points.shape[1] != 3:
            raise ValueError(f"fit: points have to be of shape (n, 3), and are of {points.shape}")
        points = points[numpy.isfinite(points).all(axis=1)]
    if not len(points):
        raise ValueError("fit: there is nothing that has an end")
    if not aspect > 0:
        raise ValueError("fit: aspect has to be above 0")
    if kind not in ("perspective", "orthographic"):
        raise ValueError("fit: kind has to be perspective or orthographic")
    along = numpy.asarray(direction, float) * numpy.ones(3)
    along = along / numpy.linalg.norm(along)
    axes = _celltrace.Camera.look_at((0, 0, 0), along, angle, 1, sky, right_handed=right_handed)
    across, up = (numpy.array(axis) / numpy.linalg.norm(axis) for axis in (axes.right, axes.up))
    wide, high = max(aspect, 1), max(1 / aspect, 1)
    u, v, w = points @ across, points @ up, points @ along
    if kind == "orthographic":
        side = max(numpy.ptp(u) / wide, numpy.ptp(v) / high) * margin or 1
        # As far before the points as they go, for the camera's own plane to be well outside.
        place = across * (u.min() + u.max()) / 2 + up * (v.min() + v.max()) / 2 + along * (w.min() - max(numpy.ptp(w), side))
        return axes.replace(kind=kind, location=place, direction=along, right=across * side * wide, up=up * side * high,
                            framing="whole")
    # Of each pair of the view's sides, where both touch the points.
    place, depth = numpy.zeros(3), numpy.inf
    for axis, x, sides in ((across, u, wide), (up, v, high)):
        slope = numpy.tan(numpy.radians(angle) / 2) * sides / margin
        least, most = (-x - slope * w).max(), (x - slope * w).max()
        place += axis * (most - least) / 2
        depth = min(depth, -(most + least) / (2 * slope))
    size = max(numpy.ptp(u), numpy.ptp(v), numpy.ptp(w)) or 1
    return axes.replace(location=place + along * min(depth, w.min() - 1e-3 * size),
                        right=numpy.multiply(axes.right, wide), up=numpy.multiply(axes.up, high), framing="whole")

"""Scenes of Mayavi, which writes them through VTK; rendered as `povray NAME.pov +W240 +H180`."""

import numpy
from mayavi import mlab

import calls

mlab.options.offscreen = True


def surface():
    x, y = numpy.mgrid[-3:3:24j, -3:3:24j]
    mlab.surf(x, y, numpy.sin(x * y) * 0.7)


def spheres():
    turn = numpy.linspace(0, 4 * numpy.pi, 24)
    mlab.points3d(numpy.cos(turn), numpy.sin(turn), 0.15 * turn, turn, scale_factor=0.03, resolution=12)


def levels():
    x, y, z = numpy.mgrid[-2:2:16j, -2:2:16j, -2:2:16j]
    mlab.contour3d(x * x + y * y * 0.6 - z * z * 0.5, contours=3, opacity=0.5)


for scene in (surface, spheres, levels):
    mlab.figure(size=(240, 180), bgcolor=(0.2, 0.2, 0.3))
    scene()
    mlab.view(40, 60)
    mlab.savefig(f"{scene.__name__}.pov")
    mlab.close()
    calls.povray(f"{scene.__name__}.pov", "+W240", "+H180")
calls.leave()

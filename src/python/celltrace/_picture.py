"""Pictures as arrays that notebooks show."""

import numpy


class Picture(numpy.ndarray):
    """An array of (height, width, 3 or 4) that a notebook shows as a picture; NumPy uses it as any other array.

    Parts and copies are Pictures, too, and so is what arithmetic makes of one, if that still has pixels of the same
    type; what has not is a plain array. numpy.asarray(picture) is one in any case.

    gamma: of float32, the power that makes colours linear, 1 for most scenes; None: they are for display as they are.
    """

    gamma = 1.0

    def __new__(cls, pixels, gamma=1.0):
        """An array as a Picture, without a copy."""
        picture = numpy.asarray(pixels).view(cls)
        picture.gamma = gamma
        return picture

    def __array_finalize__(self, source):
        self.gamma = getattr(source, "gamma", 1.0)

    def __array_wrap__(self, made, context=None, return_scalar=False):
        if made.dtype == self.dtype and _is_shown(made):
            return super().__array_wrap__(made, context)
        made = numpy.asarray(made)
        return made if made.ndim else made[()]

    def __reduce__(self):
        make, arguments, state = super().__reduce__()
        return make, arguments, (state, self.gamma)

    def __setstate__(self, state):
        super().__setstate__(state[0])
        self.gamma = state[1]

    def _repr_png_(self):
        if not _is_shown(self):
            return None
        from celltrace import encode
        return encode(self)


def _is_shown(array):
    return (array.ndim == 3 and array.shape[2] in (3, 4) and array.size > 0
            and array.dtype in (numpy.uint8, numpy.uint16, numpy.float32))

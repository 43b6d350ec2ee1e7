"""Pictures of atoms as ASE makes them by POV-Ray, in process and without files.

    picture = celltrace.ase.render(atoms, rotation="10z,-80x", width=600, bonds=True)

Geometry, colours and settings are those of ase.io.write("x.pov", atoms, ...), whose keywords are taken here: rotation,
show_unit_cell, radii, bbox, colors, and those of its povray_settings, such as textures, transmittances, celllinewidth.
"""

import inspect

import numpy
from ase.io.pov import POVRAY, get_bondpairs
from ase.io.utils import PlottingVariables

import celltrace

__all__ = ["render", "scene"]

_ANTIALIASING = celltrace.Antialiasing(threshold=0.1)  # what ASE asks POV-Ray for
_RENDERING = [name for name in inspect.signature(celltrace.Session).parameters if name not in ("scene", "width", "height")]


def render(atoms, *, width=None, height=None, progress=None, **keywords):
    """A Picture of atoms. width or height: in pixels; neither: as many as ASE takes. Further keywords are those of
    scene(), and those of celltrace.render(), where antialiasing and alpha are on unless said otherwise."""
    options = {name: keywords.pop(name) for name in _RENDERING if name in keywords}
    atoms_scene, size = _scene(atoms, width, height, keywords)
    options = {"antialiasing": _ANTIALIASING, "alpha": atoms_scene.background_transparency > 0, **options}
    return celltrace.render(atoms_scene, width=size[0], height=size[1], progress=progress, **options)


def scene(atoms, **keywords):
    """The Scene of atoms, for a Session or to add something: a length of 1 is an angstrom, z points at the viewer.

    bonds: True for all bonds that ASE finds, or a list as its bondatoms. Further keywords: rotation, show_unit_cell,
    radii, bbox, colors, extra_offset, and ASE's povray_settings.
    """
    return _scene(atoms, None, None, keywords)[0]


def _scene(atoms, width, height, keywords):
    """The scene, and the size of its picture."""
    keywords = {**keywords.pop("povray_settings", {}), **keywords}
    bonds = keywords.pop("bonds", None)
    if bonds is not None and bonds is not False:
        keywords["bondatoms"] = get_bondpairs(atoms) if bonds is True else bonds
    if keywords.get("isosurfaces"):
        raise NotImplementedError("isosurfaces: add them to the Scene, as a Mesh")
    plotting = inspect.signature(PlottingVariables).parameters
    variables = PlottingVariables(atoms, scale=1.0,
                                  **{name: keywords.pop(name) for name in list(keywords) if name in plotting})
    if width is not None and height is not None:
        keywords["canvas_width"] = width
    else:
        keywords.update({name: value for name, value in (("canvas_width", width), ("canvas_height", height))
                         if value is not None})
    settings = POVRAY.from_PlottingVariables(variables, **keywords)
    made = celltrace.Scene.from_text(_surroundings(settings))
    materials = _Materials(made, settings)
    _add_cell(made, settings, materials)
    _add_atoms(made, settings, materials)
    _add_bonds(made, settings, materials)
    return made, (int(settings.canvas_width), int(settings.canvas_height if height is None else height))


def _vector(numbers):
    return "<" + ", ".join(repr(float(number)) for number in numbers) + ">"


def _colour(colour):
    if isinstance(colour, str):
        return {"white": "rgb 1", "black": "rgb 0"}.get(colour.lower(), colour)
    if isinstance(colour, float):
        return f"rgb {colour}"
    return {3: "rgb ", 4: "rgbt ", 5: "rgbft "}[len(colour)] + _vector(colour)


def _surroundings(settings):
    """Camera, lights and background in POV-Ray's language."""
    colours = [settings.background, *(colour for _, colour in settings.point_lights),
               *([settings.area_light[1]] if settings.area_light else [])]
    needs_names = any(isinstance(colour, str) and colour.lower() not in ("white", "black") for colour in colours)
    text = ['#include "colors.inc"'] if needs_names else []
    text += ["global_settings { assumed_gamma 1 max_trace_level 6 }",
             f"background {{ {_colour(settings.background)} {'transmit 1' if settings.transparent else ''} }}",
             f"camera {{ {settings.camera_type} right {-settings.image_width} * x up {settings.image_height} * y "
             f"direction {settings.image_plane} * z location <0, 0, {settings.camera_dist}> look_at 0 }}"]
    text += [f"light_source {{ {_vector(place)}, {_colour(colour)} }}" for place, colour in settings.point_lights]
    if settings.area_light is not None:
        place, colour, across, along, columns, rows = settings.area_light
        text.append(f"light_source {{ {_vector(place)}, {_colour(colour)} area_light <{across}, 0, 0>, <0, {along}, 0>, "
                    f"{columns}, {rows} adaptive 1 jitter }}")
    if settings.depth_cueing and settings.cue_density >= 1e-4:
        text.append(f"fog {{ fog_type 1 distance {1 / min(settings.cue_density, 1e4)} {_colour(settings.background)} }}")
    return "\n".join(text)


class _Materials:
    """Indices of materials, one for all that look the same."""

    def __init__(self, scene, settings):
        self.scene, self.settings = scene, settings
        self.finishes, self.indices = {}, {}

    def of_atom(self, atom):
        texture = self.settings.textures[atom] if self.settings.textures is not None else "ase3"
        transmit = self.settings.transmittances[atom] if self.settings.transmittances is not None else 0
        return self.of(self.settings.colors[atom], texture, transmit)

    def of(self, colour, texture, transmit=0):
        parts = tuple(numpy.atleast_1d(colour).astype(float)) if not isinstance(colour, str) else celltrace.srgb(colour)
        key = parts, texture, float(transmit)
        if key not in self.indices:
            if texture not in self.finishes:
                style = self.settings.material_styles_dict.get(texture, "") if texture else ""
                if texture and not style:
                    raise ValueError(f"textures: ASE has no style '{texture}'")
                self.finishes[texture] = celltrace.Material.from_pov(style)
            material = self.finishes[texture].replace(colour=parts[:3] if len(parts) > 1 else parts * 3, transmit=transmit)
            self.indices[key] = self.scene.add_material(material)
        return self.indices[key]


def _add_cell(scene, settings, materials):
    if settings.cell_vertices is None:
        return
    for axis in range(3):
        starts = numpy.moveaxis(settings.cell_vertices, axis, 0)
        for start, end in zip(starts[0].reshape(-1, 3), starts[1].reshape(-1, 3)):
            if numpy.linalg.norm(end - start) >= 1e-12:
                scene.add(celltrace.Cylinder(start, end, settings.celllinewidth), material=materials.of((0, 0, 0), None))


def _add_atoms(scene, settings, materials):
    for atom, (place, diameter) in enumerate(zip(settings.positions[:len(settings.diameters)], settings.diameters)):
        scene.add(celltrace.Sphere(place, diameter / 2), material=materials.of_atom(atom))
    if settings.exportconstraints:
        for atom in settings.constrainatoms:
            for turn in (45, -45):
                scene.add(celltrace.Torus(settings.diameters[atom] / 2, settings.celllinewidth),
                          transform=celltrace.Transform.rotate((0, 0, turn)).then(
                              celltrace.Transform.translate(settings.positions[atom])),
                          material=materials.of((0, 0, 0), "ase3"))


def _add_bonds(scene, settings, materials):
    """Two halves for each bond, in the colours of their atoms; double and triple bonds lie side by side."""
    for bond in settings.bondatoms:
        first, second, offset, order, shift = (*bond, *(None, None, (0, 0, 0), 1, None)[len(bond):])
        if order not in (0, 1, 2, 3):
            raise ValueError(f"bonds: the order of {bond} has to be 0 to 3")
        ends = settings.positions[first], settings.positions[second]
        across = numpy.dot(offset, settings.cell)
        middles = (ends[0] + ends[1] + across) / 2, (ends[0] + ends[1] - across) / 2
        if order > 1:
            shift = (settings.bondlinewidth, settings.bondlinewidth, 0) if shift is None else shift
            shift = _beside(middles[0] - ends[0], numpy.array(shift, float))
        for share in ((), (0,), (-0.5, 0.5), (-1, 0, 1))[order]:
            beside = share * shift if share else numpy.zeros(3)
            for atom, end, middle in zip((first, second), ends, middles):
                scene.add(celltrace.Cylinder(end + beside, middle + beside, settings.bondlinewidth),
                          material=materials.of_atom(atom))


def _beside(along, shift):
    """A shift of the same length and in its plane with the bond, but at a right angle to that."""
    along = along / numpy.linalg.norm(along)
    across = shift - along * numpy.dot(along, shift)
    length = numpy.linalg.norm(across)
    return across * numpy.linalg.norm(shift) / length if length > 1e-9 else shift

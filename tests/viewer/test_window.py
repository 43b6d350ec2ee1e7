#!/usr/bin/env python3
"""Drives `celltrace view` by real keys and a mouse, on a display of its own, and checks what it shows: by the lines
that it writes about its state, and by the pixels of the display.

    test_window.py CELLTRACE

Exits with 77 where Xvfb or xdotool are missing."""

import ctypes
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time

SCENE = """
#version 3.7;
global_settings { assumed_gamma 1.0 }
background { rgb <0.1, 0.2, 0.4> }
camera { location <0, 1, -6> look_at <0, 0, 0> angle 45 right x*image_width/image_height }
light_source { <-4, 6, -8> rgb 1 }
sphere { <-1, 0, 0>, 0.9 pigment { rgb %s } }
sphere { <1.2, 0, 1>, 0.9 pigment { rgb <0.2, 0.8, 0.3> } finish { reflection 0.3 } }
sphere { <0, -101, 0>, 100 pigment { rgb 0.8 } }
"""
RED, BLUE = "<0.9, 0.1, 0.1>", "<0.1, 0.1, 0.9>"


class NoDisplay(Exception):
    """Xvfb does not run here."""


class Display:
    """An X server whose framebuffer is a file."""

    def __init__(self, folder):
        self.folder = folder
        read, write = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1024x768x24", "-fbdir", folder, "-nolisten", "tcp",
             "-noreset"],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            number = answer.readline().strip()
        self.environment = dict(os.environ, DISPLAY=":" + number)
        self.environment.pop("SDL_VIDEODRIVER", None)
        for _ in range(100):
            if subprocess.run(["xdotool", "getdisplaygeometry"], env=self.environment, timeout=20,
                              capture_output=True).returncode == 0:
                return
            time.sleep(0.1)
        self.stop()
        raise NoDisplay()

    def tool(self, *arguments):
        done = subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, check=True, capture_output=True,
                              timeout=20)
        return done.stdout.decode().strip()

    def pixels(self, left, top, width, height):
        """Rows of (r, g, b)."""
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as file:
            data = file.read()
        header = struct.unpack(">25I", data[:100])
        start, pitch, colours = header[0], header[12], header[19]
        start += colours * 12
        rows = []
        for y in range(top, top + height):
            row = data[start + y * pitch + left * 4:start + y * pitch + (left + width) * 4]
            rows.append([(row[x + 2], row[x + 1], row[x]) for x in range(0, len(row), 4)])
        return rows

    def stop(self):
        self.process.terminate()
        self.process.wait()


class Viewer:
    all = []

    def __init__(self, display, program, folder, *arguments):
        self.display = display
        self.folder = folder
        self.state_file = os.path.join(folder, "state.json")
        open(self.state_file, "w").close()
        self.started = time.monotonic()
        self.process = subprocess.Popen([program, "view", "scene.pov", "-W", "320", "-H", "240", "--state", self.state_file,
                                         *arguments], cwd=folder, env=display.environment)
        Viewer.all.append(self.process)
        self.lines = 0
        self.state = {}
        self.wait("the first picture", lambda s: s["final"])
        self.window = self.find_window()
        display.tool("windowfocus", self.window)

    def find_window(self):
        for _ in range(100):
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "celltrace"], timeout=20,
                                   env=self.display.environment, capture_output=True).stdout.split()
            if found:
                return found[-1].decode()
            time.sleep(0.05)
        raise AssertionError("there is no window")

    def wait(self, what, condition, seconds=30):
        """Until a line of the state that has not been looked at yet fulfils the condition."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            with open(self.state_file) as file:
                lines = [line for line in file.readlines() if line.endswith("\n")]
            for line in lines[self.lines:]:
                try:
                    self.state = json.loads(line)
                except json.JSONDecodeError:
                    break  # read while it was written: once more
                self.lines += 1
                if condition(self.state):
                    return self.state
            if self.process.poll() is not None:
                raise AssertionError("%s: the viewer ended with %d" % (what, self.process.returncode))
            time.sleep(0.01)
        raise AssertionError("%s: not within %d s; the state is %s" % (what, seconds, self.state))

    def wait_until_still(self):
        """Returns the state when nothing has been asked for a while, with nothing written over the picture."""
        if not (self.state["still"] and self.state["message"] == "" and self.state["hint"] == ""):
            self.wait("still", lambda s: s["still"] and s["message"] == "" and s["hint"] == "")
        return self.state

    def key(self, name):
        # Not checked: a key that ends the program takes the window away before it is up again.
        subprocess.run(["xdotool", "key", "--window", self.window, name], env=self.display.environment, timeout=20,
                       capture_output=True)

    def press(self, name, what, condition):
        self.key(name)
        return self.wait("%s (key %s)" % (what, name), condition)

    def leave_help(self, key):
        """In a small window help has several pages."""
        for _ in range(self.state["help_pages"]):
            self.key(key)
        self.wait("no help", lambda s: not s["help"])

    def place(self):
        values = dict(line.split("=") for line in
                      self.display.tool("getwindowgeometry", "--shell", self.window).splitlines())
        return int(values["X"]), int(values["Y"]), int(values["WIDTH"]), int(values["HEIGHT"])

    def pixels(self):
        return self.display.pixels(*self.place())

    def settled_pixels(self):
        """As soon as the display has what the state says."""
        before = self.pixels()
        for _ in range(100):
            time.sleep(0.05)
            now = self.pixels()
            if now == before:
                return now
            before = now
        return before


def check(condition, what):
    if not condition:
        raise AssertionError(what)


def share_of(rows, is_wanted):
    pixels = [pixel for row in rows for pixel in row]
    return sum(map(is_wanted, pixels)) / len(pixels)


def is_red(pixel):
    return pixel[0] > 100 and pixel[1] < 80 and pixel[2] < 80


def is_blue(pixel):
    return pixel[2] > 90 and pixel[0] < 60 and pixel[1] < 60


def moved(before):
    return lambda s: s["final"] and s["camera"]["location"] != before["camera"]["location"]


def turned(before):
    return lambda s: s["final"] and s["camera"]["direction"] != before["camera"]["direction"]


def near(a, b, distance):
    return sum((x - y) ** 2 for x, y in zip(a, b)) < distance ** 2


def point_between(one, other):
    """The point that is as near as can be to both cameras' axes."""
    def dot(a, b):
        return sum(x * y for x, y in zip(a, b))
    p, d, q, e = one["location"], one["direction"], other["location"], other["direction"]
    w = [x - y for x, y in zip(p, q)]
    a, b, c = dot(d, d), dot(d, e), dot(e, e)
    t = (b * dot(e, w) - c * dot(d, w)) / (a * c - b * b)
    return [x + t * y for x, y in zip(p, d)]


def drive(display, program, folder):
    with open(os.path.join(folder, "scene.pov"), "w") as file:
        file.write(SCENE % RED)
    viewer = Viewer(display, program, folder)
    state = viewer.state
    initial = state["camera"]
    check(state["antialiased"], "the picture at rest is antialiased")
    check(state["backend"] == "native" and state["mode"] == "planar", "it begins on native, planar")
    check("H: help" in state["hint"] and "planar" in state["hint"], "it says how to get help, and the mode")
    viewer.wait("the hint is gone", lambda s: s["hint"] == "" and s["still"])
    first = viewer.settled_pixels()
    check(share_of(first, is_red) > 0.05, "the red sphere is on the display")

    # Movement: arrows and letters, planar and radial.
    for keys in (("Left", "d"), ("Right", "a"), ("Up", "s"), ("Down", "w"), ("Prior", "v"), ("Next", "r")):
        before = viewer.state
        viewer.press(keys[0], "movement", moved(before))
        check(viewer.pixels() != first, "what is seen has moved")
        viewer.press(keys[1], "movement back", moved(viewer.state))
        distance = sum((a - b) ** 2 for a, b in zip(before["camera"]["location"], viewer.state["camera"]["location"]))
        check(distance < 1e-12, "the other key leads back")
    check(viewer.settled_pixels() == first, "the same place shows the same picture")
    viewer.press("m", "radial", lambda s: s["mode"] == "radial" and "radial" in s["hint"])
    before = viewer.state
    viewer.press("Left", "around the scene", turned(before))
    viewer.press("Up", "over the scene", turned(viewer.state))
    viewer.press("Home", "reset", lambda s: s["final"] and s["camera"] == initial)
    viewer.press("m", "planar", lambda s: s["mode"] == "planar")

    # A key that is held down goes on.
    display.tool("keydown", "--window", viewer.window, "Left")
    places = set()
    viewer.wait("many frames", lambda s: places.add(tuple(s["camera"]["location"])) or len(places) > 8)
    display.tool("keyup", "--window", viewer.window, "Left")
    viewer.press("0", "reset", lambda s: s["final"] and s["camera"] == initial)

    # Zoom: keys and the wheel.
    size = share_of(viewer.settled_pixels(), is_red)
    for _ in range(4):
        viewer.press("plus", "zoom in", turned(viewer.state))
    check(share_of(viewer.settled_pixels(), is_red) > 1.2 * size, "things are larger")
    for _ in range(4):
        viewer.press("minus", "zoom out", turned(viewer.state))
    left, top, width, height = viewer.place()
    display.tool("mousemove", left + width // 2, top + height // 2)
    display.tool("click", 4)
    viewer.wait("zoom by the wheel", turned(before))
    display.tool("click", 5)
    viewer.wait("and back", lambda s: s["final"])

    # The mouse goes around what is in the middle, looks around and moves.
    middle = {"mousemove": (left + width // 2, top + height // 2)}
    viewer.press("Home", "reset", lambda s: s["final"] and s["camera"] == initial)
    display.tool("mousemove", *middle["mousemove"])
    time.sleep(0.2)
    display.tool("mousedown", 1)
    time.sleep(0.3)  # until it knows what is in the middle
    display.tool("mousemove_relative", 40, 10, "mouseup", 1)
    viewer.wait("going around by the mouse", moved({"camera": initial}))
    around = viewer.wait_until_still()["camera"]
    check(around["direction"] != initial["direction"], "it goes on looking there")
    check(near(point_between(around, initial), (0, -1.31, 7.85), 0.1),  # of the ground
          "around what is in the middle")
    for buttons in ((["mousedown", 3], ["mouseup", 3]),
                    (["keydown", "shift", "mousedown", 1], ["mouseup", 1, "keyup", "shift"])):
        display.tool("mousemove", *middle["mousemove"])
        before = viewer.wait_until_still()
        display.tool(*buttons[0])
        display.tool("mousemove_relative", 40, 10)
        viewer.wait("looking around by the mouse", turned(before))
        display.tool(*buttons[1])
        check(viewer.wait_until_still()["camera"]["location"] == before["camera"]["location"], "in its place")
    display.tool("mousemove", *middle["mousemove"])
    before = viewer.wait_until_still()
    display.tool("mousedown", 2, "mousemove_relative", 20, 0, "mouseup", 2)
    viewer.wait("moving by the mouse", moved(before))
    viewer.press("Home", "reset", lambda s: s["final"] and s["camera"] == initial)

    # A click says what is there.
    left, top, width, height = viewer.place()
    display.tool("mousemove", left + width // 2, top + height // 2, "click", 1)
    state = viewer.wait("an object", lambda s: s.get("picked", {}).get("object") is not None)
    picked = state["picked"]
    check(picked["kind"] == "sphere" and picked["name"] == "" and picked["file"] == "scene.pov", "its kind and file")
    check(SCENE.splitlines()[picked["line"] - 1].startswith("sphere"), "and line")
    check(state["message"].startswith("sphere at scene.pov:%d, " % picked["line"]), "and says so: " + state["message"])
    check(state["camera"] == initial, "and moves nothing")
    display.tool("mousemove", left + 2, top + 2, "click", 1)
    viewer.wait("nothing there", lambda s: s["picked"]["object"] is None and s["message"] == "nothing")
    viewer.wait("the message is gone", lambda s: s["message"] == "")

    # Views.
    viewer.press("c", "next camera", lambda s: s["final"] and s["view"] == "front")
    viewer.press("c", "next camera", lambda s: s["final"] and s["view"] == "right")
    for view in ("back", "left", "above", "corner", "the scene's own"):
        viewer.press("c", "next camera", lambda s, view=view: s["final"] and s["view"] == view)

    # What is written over the picture.
    viewer.wait_until_still()
    plain = viewer.settled_pixels()
    check(plain == first, "the scene's own camera shows what it did")
    for key, name in (("i", "information"), ("h", "help")):
        viewer.press(key, name, lambda s, name=name: s[name])
        check(viewer.settled_pixels() != plain, name + " is seen")
    viewer.leave_help("F1")
    viewer.press("i", "no information", lambda s: not s["information"])
    check(viewer.settled_pixels() == plain, "without it the picture is as before")
    viewer.press("l", "strips", lambda s: s["strips"] and s["final"] and s["patches"] > 0)
    strips = viewer.settled_pixels()
    check(strips != plain, "strips are seen")
    viewer.press("k", "costs", lambda s: s["costs"] and not s["strips"] and s["final"] and s["patches"] > 0)
    check(viewer.settled_pixels() not in (plain, strips), "costs are seen")
    viewer.press("k", "no costs", lambda s: not s["costs"])

    # Screenshots: the picture, without what is written over it.
    viewer.press("p", "screenshot", lambda s: s["screenshot"] == "scene-001.png" and "saved" in s["message"])
    check(os.path.exists(os.path.join(folder, "scene-001.png")), "the screenshot is there")
    viewer.press("F12", "second screenshot, under a message", lambda s: s["screenshot"] == "scene-002.png")
    viewer.press("h", "help", lambda s: s["help"])
    viewer.press("i", "information", lambda s: s["information"])
    viewer.press("p", "third screenshot", lambda s: s["screenshot"] == "scene-003.png")
    viewer.leave_help("h")
    viewer.press("i", "no information", lambda s: not s["information"])
    viewer.wait("the message is gone", lambda s: s["message"] == "")
    viewer.press("p", "fourth screenshot", lambda s: s["screenshot"] == "scene-004.png")
    for name in ("scene-001.png", "scene-002.png", "scene-003.png"):
        compared = subprocess.run([program, "compare", "--min-psnr", "90", name, "scene-004.png"], cwd=folder,
                                  capture_output=True)
        check(compared.returncode == 0, "screenshots of the same are the same: " + name)
    viewer.wait("the message is gone again", lambda s: s["message"] == "")

    # Machines.
    viewer.press("x", "no antialiasing", lambda s: s["final"] and not s["antialiased"] and not s["antialiasing"])
    viewer.press("b", "the emulated Cell", lambda s: s["final"] and s["spu"] == "cell_emu" and s["virtual_cycles"] > 0)
    viewer.press("n", "pipeline", lambda s: s["final"] and s["model"] == 1)
    viewer.press("n", "split pipeline", lambda s: s["final"] and s["model"] == 2)
    viewer.press("n", "offload", lambda s: s["final"] and s["model"] == 3)
    viewer.press("n", "shared", lambda s: s["final"] and s["model"] == 0)
    while viewer.state["backend"] != "native":
        backend = viewer.state["backend"]
        viewer.press("b", "next backend", lambda s, backend=backend: s["backend"] != backend)
    viewer.wait("native", lambda s: s["final"] and s["spu"].startswith("native"))
    viewer.press("x", "antialiasing", lambda s: s["final"] and s["antialiased"])
    check(viewer.settled_pixels() == plain, "the picture is the first one again")

    # The scene's file is watched.
    with open(os.path.join(folder, "scene.pov"), "w") as file:
        file.write(SCENE % BLUE)
    viewer.wait("the scene as it was saved", lambda s: not s["final"])
    viewer.wait("its picture", lambda s: s["final"])
    check(share_of(viewer.settled_pixels(), is_blue) > 0.03, "the sphere is blue now")
    with open(os.path.join(folder, "scene.pov"), "w") as file:
        file.write("sphere { <0, 0, 0> oops")
    state = viewer.wait("the error", lambda s: s["error"] != "")
    check("scene.pov:1:" in state["error"] and "error:" in state["error"], "the error says where: " + state["error"])
    check(share_of(viewer.settled_pixels(), is_blue) > 0.03, "the old picture stays")
    with open(os.path.join(folder, "scene.pov"), "w") as file:
        file.write(SCENE % RED)
    viewer.wait("no error", lambda s: s["error"] == "" and s["final"])
    check(share_of(viewer.settled_pixels(), is_red) > 0.05, "and red again")

    # Pause.
    viewer.press("space", "pause", lambda s: s["paused"])
    viewer.key("Left")
    time.sleep(0.3)
    check(viewer.settled_pixels() != [], "nothing ends")
    viewer.press("space", "go on", lambda s: not s["paused"] and s["final"])
    viewer.press("Home", "reset", lambda s: s["final"])

    # Sizes.
    display.tool("windowsize", viewer.window, 500, 300)
    viewer.wait("larger", lambda s: s["final"] and s["picture"] == [500, 300])
    viewer.press("f", "full screen", lambda s: s["full_screen"])
    viewer.press("F11", "window", lambda s: not s["full_screen"])

    viewer.key("q")
    start = time.monotonic()
    check(viewer.process.wait(5) == 0, "q ends it with 0")
    check(time.monotonic() - start < 1, "at once")
    display.tool("keyup", "q")  # or it is repeated to the next window: this one was gone before the key was up


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("message_type", ctypes.c_ulong),
                ("format", ctypes.c_int), ("data", ctypes.c_long * 5), ("padding", ctypes.c_long * 24)]


def press_close_button(display, window):
    """What a window manager sends."""
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype = ctypes.c_void_p
    x.XInternAtom.restype = ctypes.c_ulong
    x.XInternAtom.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
    x.XSendEvent.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long, ctypes.c_void_p]
    x.XCloseDisplay.argtypes = [ctypes.c_void_p]
    connection = x.XOpenDisplay(display.environment["DISPLAY"].encode())
    message = ClientMessage(type=33, window=int(window), format=32,
                            message_type=x.XInternAtom(connection, b"WM_PROTOCOLS", 0))
    message.data[0] = x.XInternAtom(connection, b"WM_DELETE_WINDOW", 0)
    x.XSendEvent(connection, int(window), 0, 0, ctypes.byref(message))
    x.XCloseDisplay(connection)


def close_button(display, program, folder):
    for end in (lambda v: press_close_button(display, v.window), lambda v: v.process.terminate()):
        viewer = Viewer(display, program, folder)
        end(viewer)
        try:
            check(viewer.process.wait(5) == 0, "it ends with 0")
        except subprocess.TimeoutExpired:
            viewer.process.kill()
            raise AssertionError("a closed window does not end it") from None


def without_display(program, folder):
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
    done = subprocess.run([program, "view", "scene.pov"], cwd=folder, env=environment, capture_output=True, timeout=20)
    check(done.returncode == 1, "without a display it ends with 1")
    check(len(done.stderr.decode().splitlines()) == 1, "and one line: " + done.stderr.decode())


def dummy_driver(program, folder):
    """SDL's driver without a display: keys come from a script."""
    state = os.path.join(folder, "dummy.json")
    keys = ["Left", "m", "Up", "i", "l", "k", "h", "c", "x", "b", "200x100", "drag:10,5", "look:5,5", "wheel:1", "click:100,50", "p", "q"]
    done = subprocess.run([program, "view", "scene.pov", "-W", "160", "-H", "120", "--state", state, "--keys",
                           " ".join(keys)],
                          cwd=folder, env=dict(os.environ, SDL_VIDEODRIVER="dummy"), capture_output=True, timeout=60)
    check(done.returncode == 0, "the dummy driver: " + done.stderr.decode())
    with open(state) as file:
        last = json.loads(file.readlines()[-1])
    check(last["mode"] == "radial" and last["information"] and last["costs"] and last["help"], "keys had their effect")
    check(last["window"] == [200, 100] and last["spu"] == "cell_emu" and last["view"] == "front", "the others, too")
    check("picked" in last, "a click is answered")


def scripted(program, folder, scene, keys, *options, size=(160, 120)):
    """Runs a script on SDL's driver without a display. Returns the process and all states."""
    state = os.path.join(folder, "scripted.json")
    done = subprocess.run([program, "view", scene, "-W", str(size[0]), "-H", str(size[1]), "--state", state, "--keys", keys,
                           *options],
                          cwd=folder, env=dict(os.environ, SDL_VIDEODRIVER="dummy"), capture_output=True, timeout=60)
    if not os.path.exists(state):
        return done, []
    with open(state) as file:
        states = [json.loads(line) for line in file]
    os.remove(state)
    return done, states


def copied_camera(program, folder):
    """A scene with the camera's text shows what the window did."""
    done, states = scripted(program, folder, "scene.pov", "x drag:60,-20 wheel:2 look:10,5 Up t p q", size=(200, 120))
    text = done.stdout.decode()
    check(done.returncode == 0 and text.startswith("camera {"), "the camera is on stdout: " + text)
    scene = SCENE % RED
    begin = scene.index("camera {")
    with open(os.path.join(folder, "copied.pov"), "w") as file:
        file.write(scene[:begin] + text + scene[scene.index("\n", begin) + 1:])
    subprocess.run([program, "copied.pov", "-W", "200", "-H", "120", "-o", "copied.png"], cwd=folder, check=True,
                   capture_output=True)
    compared = subprocess.run([program, "compare", "--min-psnr", "90", "copied.png", states[-1]["screenshot"]], cwd=folder,
                              capture_output=True)
    check(compared.returncode == 0, "and the picture is the same: " + compared.stdout.decode())


def unreadable_scenes(program, folder):
    done, states = scripted(program, folder, "none.pov", "q")
    check(done.returncode == 1 and not states, "a scene that is not there opens no window")
    check(done.stderr.decode() == "celltrace: error: none.pov: there is no such file\n", done.stderr.decode())
    with open(os.path.join(folder, "broken.pov"), "w") as file:
        file.write("sphere { oops }")
    done, states = scripted(program, folder, "broken.pov", "q")
    check(done.returncode == 1, "a scene that could never be read ends with 1")
    check(done.stderr.decode().startswith("broken.pov:1:10: error: "), done.stderr.decode())
    check(states[-1]["error"].startswith("broken.pov:1:10: error: "), "the window says so, too")


def dark_scene(program, folder):
    with open(os.path.join(folder, "dark.pov"), "w") as file:
        file.write("#version 3.7; global_settings { assumed_gamma 1 }\n"
                   "camera { location -5*z }\n#declare Ball = sphere { 0, 1 }\nobject { Ball }")
    done, states = scripted(program, folder, "dark.pov", "click:80,60 q")
    check(any("no light source" in state["message"] for state in states), "a scene without lights says so")
    check(states[-1]["message"].startswith("sphere 'Ball' at dark.pov:4, "), "a click names it: " + states[-1]["message"])
    done, states = scripted(program, folder, "scene.pov", "q")
    check(not any("no light source" in state["message"] for state in states), "others do not")


def small_window(program, folder):
    done, states = scripted(program, folder, "scene.pov", "h q", size=(800, 600))
    check(states[-1]["help_pages"] == 1 and states[-1]["help"], "a window has room for all help")
    pages = scripted(program, folder, "scene.pov", "h q", size=(200, 120))[1][-1]["help_pages"]
    check(pages > 1, "a small one has pages")
    done, states = scripted(program, folder, "scene.pov", " ".join(["h"] * pages) + " q", size=(200, 120))
    check(states[-1]["help"], "through which H goes")
    done, states = scripted(program, folder, "scene.pov", " ".join(["h"] * (pages + 1)) + " q", size=(200, 120))
    check(not states[-1]["help"], "and then it ends")


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scene.pov"), "w") as file:
            file.write(SCENE % RED)
        without_display(program, folder)
        dummy_driver(program, folder)
        for part in (copied_camera, unreadable_scenes, dark_scene, small_window):
            part(program, folder)
        if not shutil.which("Xvfb") or not shutil.which("xdotool"):
            print("Skipped in part: Xvfb or xdotool are missing.")
            return 77
        try:
            display = Display(folder)
        except NoDisplay:
            print("Skipped in part: Xvfb does not answer.")
            return 77
        try:
            for name in os.listdir(folder):
                if name.startswith("scene-"):
                    os.remove(os.path.join(folder, name))
            drive(display, program, folder)
            close_button(display, program, folder)
        finally:
            for process in Viewer.all:
                process.kill()
            display.stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())

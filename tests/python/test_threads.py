"""Progress, cancelling, signals, and other threads meanwhile. Times are the processor's, as a machine may be busy."""

import os
import signal
import threading
import time

import celltrace
import pytest

ENDLESS = "#declare A = 1; #while (A) #declare A = A + 1; #end"  # for all the parser can tell it may end


def test_progress_grows_to_one(scene_file):
    heard = []
    celltrace.render(scene_file, width=400, height=300, progress=heard.append)
    assert heard == sorted(heard) and heard[0] >= 0 and heard[-1] == 1


def test_false_cancels(ball, slow_options):
    start = time.process_time()
    with pytest.raises(celltrace.Cancelled):
        celltrace.render(ball, progress=lambda fraction: False, **slow_options)
    assert time.process_time() - start < 2


@pytest.mark.parametrize("work", [
    lambda hear: celltrace.Scene.from_text(ENDLESS, progress=hear),
    lambda hear: celltrace.Scene.from_text("#declare A = 1;\n" * 300000, progress=hear),
])
def test_false_cancels_reading(work):
    with pytest.raises(celltrace.Cancelled):
        work(lambda fraction: False)


def test_what_progress_raises_comes_through(ball, slow_options):
    def complain(fraction):
        raise LookupError("mine")
    session = celltrace.Session(ball, **slow_options)
    with pytest.raises(LookupError, match="mine"):
        session.render(progress=complain)
    session.set_picture(width=10, height=10, antialiasing=None)
    assert session.render().any()


@pytest.fixture
def interrupts():
    """Ctrl-C raises KeyboardInterrupt, which shells take from what they start in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("what", ["render", "session", "read"])
def test_an_interrupt_ends_it_soon(ball, slow_options, interrupts, what):
    session = celltrace.Session(ball, **slow_options)
    work = {
        "render": lambda: celltrace.render(ball, **slow_options),
        "session": session.render,
        "read": lambda: celltrace.Scene.from_text(ENDLESS, limits={"loop-steps": 1 << 40}),
    }[what]
    sent = []

    def interrupt():
        sent.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)
    timer = threading.Timer(0.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        work()
    assert time.process_time() - sent[0] < 1
    timer.join()


def test_other_threads_run_meanwhile(ball, slow_options):
    """Were the interpreter's lock held, the thread would not count to end the frame."""
    session = celltrace.Session(ball, **slow_options)
    counted = 0

    def count():
        nonlocal counted
        while counted < 1000:
            counted += 1
            time.sleep(0.0001)
        session.cancel()
    thread = threading.Thread(target=count)
    thread.start()
    with pytest.raises(celltrace.Cancelled):
        while True:  # the thread may be through before a frame begins
            session.render()
    thread.join()
    assert counted == 1000


def test_a_session_that_renders_is_left_alone(ball, slow_options):
    session = celltrace.Session(ball, **slow_options)
    heard = []

    def meddle(fraction):
        with pytest.raises(celltrace.Error, match="is rendering"):
            session.set_camera(celltrace.Camera())
        with pytest.raises(celltrace.Error, match="is rendering"):
            session.render()
        heard.append(fraction)
        return False
    with pytest.raises(celltrace.Cancelled):
        session.render(progress=meddle)
    assert heard


def test_scenes_render_at_once_while_they_change(ball):
    expected = celltrace.render(ball, width=200, height=150)
    pictures = []
    threads = [threading.Thread(target=lambda: pictures.append(celltrace.render(ball, width=200, height=150)))
               for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(pictures) == 4 and all((picture == expected).all() for picture in pictures)

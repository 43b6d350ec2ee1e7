"""A replacement policy: which line of a full cache makes room for another one. Yours is to be better than LRU.

Lines are numbers. `kind` says what a program looked for in a line: the tracer's are 0 lists (with the nodes of its tree),
1 objects, 2 materials, 3 lights.
"""


class Policy:
    """First in, first out: what was fetched first goes first."""

    def __init__(self, ways):
        """An empty cache of `ways` lines."""
        self.queue = []

    def hit(self, line, kind):
        """A line was asked for that is in the cache."""

    def fetched(self, line, kind):
        """A line was asked for that is not, and has been fetched. There was room, or victim() has made it."""
        self.queue.append(line)

    def victim(self):
        """Names the line that goes, and forgets it."""
        return self.queue.pop(0)

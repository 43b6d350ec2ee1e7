"""LRU in which some kinds of lines age faster: of lights there are few, and every hit asks for them; an object or a
material, once shaded, is seldom asked for again."""

AGES = {0: 1, 1: 2, 2: 2, 3: 0.3}  # by kind


class Policy:
    def __init__(self, ways):
        self.now = 0
        self.lines = {}  # line: when it was last asked for, and how fast it ages

    def hit(self, line, kind):
        self.now += 1
        self.lines[line] = (self.now, AGES.get(kind, 1))

    def fetched(self, line, kind):
        self.hit(line, kind)

    def age(self, line):
        then, speed = self.lines[line]
        return (self.now - then) * speed

    def victim(self):
        oldest = max(self.lines, key=self.age)
        del self.lines[oldest]
        return oldest

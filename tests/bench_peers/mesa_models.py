"""The Game of Life and a forest fire in Mesa.

    mesa_models.py MODEL KIND SIDE STEPS FILE

MODEL is Life (on a torus) or Fire; KIND is agents (one for each cell or tree) or layer (a
property layer, which is a NumPy array). FILE holds the first cells as bytes and gets the last
ones. Prints the CPU nanoseconds of each step.
"""

import sys
import time

import mesa
import numpy as np
from mesa.discrete_space import FixedAgent, OrthogonalMooreGrid


class Cell(FixedAgent):
    """A cell or a tree: decides by its neighbours, then becomes what it decided."""

    def __init__(self, model, cell, value):
        super().__init__(model)
        self.cell = cell
        self.value = value

    def meet(self):
        self.others = list(self.cell.neighborhood.agents)

    def decide_life(self):
        alive = sum(other.value for other in self.others)
        self.next = int(alive == 3 or (alive == 2 and self.value == 1))

    def decide_fire(self):
        if self.value == 1:
            self.next = 2 if any(other.value == 2 for other in self.others) else 1
        else:
            self.next = 0

    def become(self):
        self.value = self.next


class Cells(mesa.Model):
    def __init__(self, name, kind, start):
        super().__init__(seed=1)
        self.name, self.kind = name, kind
        self.grid = OrthogonalMooreGrid(start.shape, torus=name == "Life", random=self.random)
        if kind == "layer":
            self.grid.create_property_layer("value", 0, dtype=int)
            self.grid.value.data[:] = start
            return
        for cell in self.grid.all_cells:
            value = int(start[cell.coordinate])
            if name == "Life" or value > 0:
                Cell(self, cell, value)
        self.agents.do("meet")

    def step(self):
        if self.kind == "agents":
            self.agents.do("decide_life" if self.name == "Life" else "decide_fire")
            self.agents.do("become")
            return
        value = self.grid.value.data
        if self.name == "Life":
            shifts = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
            alive = sum(np.roll(value, shift, (0, 1)) for shift in shifts)
            value[:] = (alive == 3) | ((alive == 2) & (value == 1))
            return
        rows, columns = value.shape
        fire = np.pad(value == 2, 1)
        near = np.zeros(value.shape, bool)
        for i in range(3):
            for j in range(3):
                near |= fire[i : i + rows, j : j + columns]
        value[:] = np.where(value == 1, np.where(near, 2, 1), 0)

    def cells(self, shape):
        if self.kind == "layer":
            return self.grid.value.data.astype(np.uint8)
        cells = np.zeros(shape, np.uint8)
        for agent in self.agents:
            cells[agent.cell.coordinate] = agent.value
        return cells


def main():
    name, kind, side, steps, path = sys.argv[1:]
    start = np.fromfile(path, np.uint8).reshape(int(side), int(side))
    model = Cells(name, kind, start)
    for _ in range(int(steps)):
        before = time.thread_time_ns()
        model.step()
        print(time.thread_time_ns() - before)
    model.cells(start.shape).tofile(path)


main()

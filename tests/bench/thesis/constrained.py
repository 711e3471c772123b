"""Delaunay's triangulation of points in a plane in which given edges are held: edges that cross them are exchanged
(Sloan 1993)."""
import numpy as np
from scipy import spatial


class Triangulation:
    """Directed edges with the corner opposite, all triangles counter-clockwise."""

    def __init__(self, points):
        self.points = points
        self.opposite = {}
        for a, b, c in spatial.Delaunay(points - points.mean(axis=0)).simplices.tolist():
            if self.side(a, b, c) < 0:
                b, c = c, b
            self.put(a, b, c)

    def side(self, a, b, c):
        """Above 0 where c lies left of the line from a to b."""
        (ax, ay), (bx, by), (cx, cy) = self.points[a], self.points[b], self.points[c]
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    def put(self, a, b, c):
        self.opposite[a, b], self.opposite[b, c], self.opposite[c, a] = c, a, b

    def crossing(self, u, v):
        """Edges that cross the line between two points, each once."""
        edges = np.array([edge for edge in self.opposite if edge[0] < edge[1]])
        p, q = self.points[edges[:, 0]], self.points[edges[:, 1]]
        a, b = self.points[u], self.points[v]

        def turn(o, d, w):
            return (d[..., 0] - o[..., 0]) * (w[..., 1] - o[..., 1]) - (d[..., 1] - o[..., 1]) * (w[..., 0] - o[..., 0])

        across = (turn(a, b, p) * turn(a, b, q) < 0) & (turn(p, q, a) * turn(p, q, b) < 0)
        apart = ~np.isin(edges, (u, v)).any(axis=1)
        return [tuple(edge) for edge in edges[across & apart].tolist()]

    def crosses(self, u, v, c, d):
        return (len({u, v, c, d}) == 4 and self.side(u, v, c) * self.side(u, v, d) < 0
                and self.side(c, d, u) * self.side(c, d, v) < 0)

    def hold(self, u, v):
        """Makes u to v an edge. @return False where a point lies on the line between them"""
        if (u, v) in self.opposite or (v, u) in self.opposite:
            return True
        waiting = self.crossing(u, v)
        for _ in range(100 * len(waiting) + 100):
            if not waiting:
                break
            a, b = waiting.pop(0)
            c, d = self.opposite[a, b], self.opposite[b, a]
            if self.side(c, d, a) * self.side(c, d, b) >= 0:
                waiting.append((a, b))  # the four are not convex yet
                continue
            del self.opposite[a, b], self.opposite[b, a]
            self.put(c, a, d)
            self.put(d, b, c)
            if self.crosses(u, v, c, d):
                waiting.append((c, d))
        return (u, v) in self.opposite or (v, u) in self.opposite

    def triangles_without(self, inside):
        """All triangles but those that are reached from these directed edges without passing one of them."""
        walls = {edge for a, b in inside for edge in ((a, b), (b, a))}
        gone = set()
        waiting = [edge for edge in inside if edge in self.opposite]
        while waiting:
            a, b = waiting.pop()
            if (a, b) in gone:
                continue
            c = self.opposite[a, b]
            gone |= {(a, b), (b, c), (c, a)}
            waiting += [(q, p) for p, q in ((a, b), (b, c), (c, a))
                        if (p, q) not in walls and (q, p) in self.opposite]
        return np.array([(a, b, c) for (a, b), c in self.opposite.items()
                         if (a, b) not in gone and a < b and a < c], dtype=int).reshape(-1, 3)

"""The parts of the bench, on surfaces whose heights are known."""
import unittest

import numpy as np

try:
    from closed import close, feet_of
    from constrained import Triangulation
    from rivals import METHODS
    from scene import figures
    from surface import Surface
except ImportError as missing:
    raise SystemExit(f"a package is missing: {missing}") from missing

TETRAHEDRON = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])


def box_skin(left, bottom, right, top, roof, foot=0.0):
    """Roof and walls of a box, open below."""
    plan = [(left, bottom), (right, bottom), (right, top), (left, top)]
    points = np.array([(x, y, foot) for x, y in plan] + [(x, y, roof) for x, y in plan])
    walls = [t for i in range(4) for t in ((i, (i + 1) % 4, i + 4), ((i + 1) % 4, (i + 1) % 4 + 4, i + 4))]
    return Surface(points, np.array(walls + [(4, 5, 6), (4, 6, 7)]))


class Surfaces(unittest.TestCase):
    def test_heights_are_those_of_the_plane(self):
        corners = np.array([(0, 0, 0), (8, 0, 16), (8, -6, 34), (0, -6, 18)], dtype=float)  # z = 2 x - 3 y
        found = Surface(corners, np.array([(0, 2, 1), (0, 3, 2)])).heights((4, 5), 2.0)
        rows, cols = np.mgrid[0:4, 0:5]
        np.testing.assert_allclose(found, 2 * (2 * cols) + 3 * (2 * rows))

    def test_the_highest_counts_and_what_is_bare_has_its_neighbours_height(self):
        low = np.array([(0, 0, 1), (4, 0, 1), (0, -4, 1)], dtype=float)
        both = Surface(np.concatenate([low, low + [0, 0, 2]]), np.array([(0, 2, 1), (3, 5, 4)]))
        np.testing.assert_array_equal(both.heights((7, 7), 1.0), np.full((7, 7), 3.0))

    def test_points_are_counted_once_and_only_where_a_triangle_is(self):
        points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0), (9, 9, 9)], dtype=float)
        self.assertEqual(Surface(points, np.array([(0, 1, 2), (3, 2, 1)])).count(), 3)

    def test_what_is_closed_has_no_open_edge(self):
        points = np.eye(4, 3)
        self.assertEqual(Surface(points, TETRAHEDRON).open_edges(), 0)
        self.assertGreater(Surface(points, TETRAHEDRON[1:]).open_edges(), 0)
        turned = np.concatenate([TETRAHEDRON[:3], TETRAHEDRON[3:, ::-1]])
        self.assertGreater(Surface(points, turned).open_edges(), 0)

    def test_figures(self):
        rmse, most, largest = figures(np.array([3.0, -4.0, 0.0, 0.0]))
        self.assertEqual((rmse, largest), (2.5, 4.0))
        self.assertAlmostEqual(most, 3.85)  # between the third and the fourth


class Constrained(unittest.TestCase):
    def test_edges_of_a_star_are_held(self):
        random = np.random.default_rng(7)
        turn = np.linspace(0, 2 * np.pi, 14, endpoint=False)
        star = np.column_stack([np.cos(turn), np.sin(turn)]) * np.where(np.arange(14) % 2, 8, 30)[:, None]
        loose = random.uniform(-40, 40, (300, 2))
        net = Triangulation(np.concatenate([star, loose]))
        edges = [(i, (i + 1) % 14) for i in range(14)]
        self.assertTrue(all(net.hold(a, b) for a, b in edges))
        self.assertTrue(all(edge in net.opposite and edge[::-1] in net.opposite for edge in edges))

        def area(triangles):
            a, b, c = (net.points[triangles[:, i]] for i in range(3))
            each = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
            self.assertTrue((each > 0).all())
            return each.sum() / 2

        of_star = np.sum(star[:, 0] * np.roll(star[:, 1], -1) - star[:, 1] * np.roll(star[:, 0], -1)) / 2
        whole = area(net.triangles_without([]))
        self.assertAlmostEqual(whole - area(net.triangles_without(edges)), of_star)


class Closed(unittest.TestCase):
    def test_a_box_on_a_slope(self):
        rows, cols = np.mgrid[0:20, 0:30]
        terrain = 0.1 * cols + 0.2 * rows
        skin = box_skin(8.5, -12.5, 18.5, -4.5, 9.0)
        self.assertEqual(len(feet_of(skin)), 4)
        whole, error = close(skin, terrain, 1.0, 0)
        self.assertEqual(whole.open_edges(), 0)
        self.assertEqual(whole.count(), 8 + 4 + 4)  # the box, the corners of the window, the plate's
        inside = (cols > 8.5) & (cols < 18.5) & (rows > 4.5) & (rows < 12.5)
        expected = np.where(inside, 9.0, terrain)
        border = np.zeros_like(inside)
        border[[0, -1]] = border[:, [0, -1]] = True  # the window is wider: there the terrain bends
        np.testing.assert_allclose(whole.heights((20, 30), 1.0)[~border], expected[~border], atol=0.3)
        self.assertLess(error, 0.3)

    def test_points_go_where_the_terrain_bends(self):
        rows, cols = np.mgrid[0:40, 0:40]
        terrain = np.hypot(rows - 20.0, cols - 20.0)
        few, rough = close(box_skin(2.5, -5.5, 5.5, -2.5, 60), terrain, 1.0, 40)
        many, fine = close(box_skin(2.5, -5.5, 5.5, -2.5, 60), terrain, 1.0, 400)
        self.assertEqual((few.count(), many.count()), (40, 400))
        self.assertEqual((few.open_edges(), many.open_edges()), (0, 0))
        self.assertLess(fine, rough / 2)


class Rivals(unittest.TestCase):
    def test_a_plane_is_met_by_all(self):
        rows, cols = np.mgrid[0:30, 0:40]
        z = 0.5 * cols + 0.25 * rows
        for name, make in METHODS.items():
            with self.subTest(name):
                made = make(z, 1.0, 100)
                self.assertLessEqual(made.count(), 100)
                np.testing.assert_allclose(made.heights(z.shape, 1.0), z, atol=1e-4)

    def test_more_points_err_less(self):
        rows, cols = np.mgrid[0:60, 0:50]
        z = 10 * np.sin(rows / 7) * np.cos(cols / 9)
        for name, make in METHODS.items():
            with self.subTest(name):
                few, many = (make(z, 1.0, budget) for budget in (100, 900))
                self.assertLessEqual(many.count(), 920)
                self.assertGreater(many.count(), few.count())
                errors = [figures(made.heights(z.shape, 1.0) - z)[0] for made in (few, many)]
                self.assertLess(errors[1], errors[0])


if __name__ == "__main__":
    unittest.main()

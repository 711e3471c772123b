"""Each count of exact_shell.py sees the fault that it is for. `python3 test_exact_shell.py`"""

import unittest

import exact_shell

CORNERS = [(x, y, z) for z in (0, 9) for y in (0, 9) for x in (0, 9)]
CUBE = {"ground": [(0, 2, 1), (1, 2, 3)], "roof": [(4, 5, 6), (5, 7, 6)],
        "wall": [(0, 1, 4), (1, 5, 4), (1, 3, 5), (3, 7, 5), (3, 2, 7), (2, 6, 7), (2, 0, 6), (0, 4, 6)]}


def shell():
    triangles = [t for group in CUBE.values() for t in group]
    return list(CORNERS), triangles, [name for name, group in CUBE.items() for _ in group]


class Counts(unittest.TestCase):
    def test_a_cube_is_well(self):
        corners, triangles, groups = shell()
        self.assertEqual(exact_shell.edge_faults(corners, triangles), (0, 0))
        self.assertEqual(exact_shell.inverted(corners, triangles, groups), 0)
        self.assertEqual(exact_shell.crossings(corners, triangles), 0)

    def test_a_triangle_that_is_missing(self):
        corners, triangles, _ = shell()
        self.assertEqual(exact_shell.edge_faults(corners, triangles[1:]), (3, 0))

    def test_a_triangle_that_is_turned(self):
        corners, triangles, groups = shell()
        triangles[2] = triangles[2][::-1]
        self.assertEqual(exact_shell.edge_faults(corners, triangles), (3, 0))
        self.assertEqual(exact_shell.inverted(corners, triangles, groups), 1)

    def test_a_cube_that_is_turned_inside_out(self):
        corners, triangles, groups = shell()
        self.assertGreaterEqual(exact_shell.inverted(corners, [t[::-1] for t in triangles], groups), 12)

    def test_cubes_that_touch_in_an_edge(self):
        corners, triangles, _ = shell()
        beside = [tuple(8 + i for i in t) for t in triangles]
        corners += [(x + 9, y + 9, z) for x, y, z in corners]
        self.assertEqual(exact_shell.edge_faults(corners, triangles + beside), (0, 1))

    def test_cubes_that_cross(self):
        corners, triangles, _ = shell()
        within = [tuple(8 + i for i in t) for t in triangles]
        corners += [(x + 3, y + 4, z + 5) for x, y, z in corners]
        self.assertGreater(exact_shell.crossings(corners, triangles + within), 0)

    def test_edges_in_the_plane_of_a_triangle(self):
        triangle = [(0, 0, 0), (8, 0, 4), (0, 8, 4)]  # x + y = 2 z
        for start, end, meets in (((2, 2, 2), (3, 1, 2), True),  # within
                                  ((-2, 4, 1), (9, 1, 5), True),  # across
                                  ((0, -2, -1), (0, 2, 1), True),  # along an edge
                                  ((8, 0, 4), (10, 0, 5), True),  # from a corner
                                  ((9, 1, 5), (1, 9, 5), False), ((0, -2, -1), (-2, 0, -1), False)):
            self.assertEqual(exact_shell.crosses(start, end, triangle), meets, (start, end))
            self.assertEqual(exact_shell.crosses(end, start, triangle[::-1]), meets, (start, end))

    def test_walls_of_one_plane_that_overlap(self):
        corners, triangles, _ = shell()
        beside = [tuple(8 + i for i in t) for t in triangles]
        corners += [(x + 3, y + 9, z + 2) for x, y, z in corners]
        self.assertGreater(exact_shell.crossings(corners, triangles + beside), 0)

    def test_corners_within_a_millimetre(self):
        millimetre = 10 ** (exact_shell.DECIMALS - 3)
        corners = [(0, 0, 0), (millimetre, 0, 0), (0, 2 * millimetre, 0)]
        self.assertEqual(exact_shell.near_corners(corners), 1)


if __name__ == "__main__":
    unittest.main()

"""Tests solids that are valid to the last step, and are none when corners within a millimetre are one."""

import unittest

from snapped_solid import crosses, faults, has_one_fan, is_simple, is_within, snapped

STEP = (0.0005, 0.0005, 0.001)  # m


def block(outline, top):
    """A block over an outline, counter-clockwise in steps, from 0 to a height."""
    n = len(outline)
    points = [(*corner, 0) for corner in outline] + [(*corner, top) for corner in outline]
    walls = [[[i, (i + 1) % n, n + (i + 1) % n, n + i]] for i in range(n)]
    return [[list(range(n))[::-1]], [list(range(n, 2 * n))], *walls], points


def faults_of(outline, top=3000, step=STEP):
    return list(faults(*block(outline, top), step))


class SnappedSolid(unittest.TestCase):
    def test_a_cube(self):
        self.assertEqual(faults_of([(0, 0), (2000, 0), (2000, 2000), (0, 2000)]), [])

    def test_corners_within_a_millimetre(self):
        self.assertEqual(snapped([(0, 0, 0), (0.001, 0, 0), (0, 0.0011, 0), (0.0008, 0.0008, 0), (5, 5, 5)]), [0, 0, 2, 2, 4])
        far = 391000.0
        self.assertEqual(snapped([(far, 0, 0), (far + 0.001, 0, 0)]), [0, 0])

    def test_a_notch_whose_ends_meet(self):
        # Two steps, a millimetre, are left between the two sides.
        notch = [(0, 0), (2000, 0), (2000, 2000), (1001, 2000), (1001, 500), (999, 500), (999, 2000), (0, 2000)]
        self.assertEqual(faults_of(notch), ["a face passes a corner twice"])
        wider = [(x + (20 if x in (1001, 2000) else 0), y) for x, y in notch]
        self.assertEqual(faults_of(wider), [])

    def test_a_corner_that_touches_another(self):
        # An hourglass whose waist is a millimetre wide: one corner less, and the rest meets in it.
        waist = [(0, 0), (2000, 0), (1001, 1000), (2000, 2000), (0, 2000), (999, 1000)]
        self.assertEqual(faults_of(waist), ["a face passes a corner twice"])

    def test_the_same_in_feet(self):
        foot = 0.3048
        narrow = [(0, 0), (2000, 0), (1003, 1000), (2000, 2000), (0, 2000), (997, 1000)]
        self.assertEqual(faults_of(narrow), [])
        self.assertEqual(faults_of(narrow, 3000, [length * foot for length in STEP]), ["a face passes a corner twice"])

    def test_a_height_of_a_millimetre(self):
        self.assertEqual(faults_of([(0, 0), (2000, 0), (2000, 2000), (0, 2000)], 1), ["a face passes a corner twice"])
        self.assertEqual(faults_of([(0, 0), (2000, 0), (2000, 2000), (0, 2000)], 2), [])

    def test_a_face_off_its_plane(self):
        for off, said in ((10, []), (100, ["a face is not plane"])):
            faces, points = block([(0, 0), (2000, 0), (2000, 2000), (0, 2000)], 3000)
            points[6] = (2000, 2000, 3000 + off)
            self.assertEqual(list(faults(faces, points, STEP)), said)

    def test_a_face_that_crosses_itself(self):
        self.assertFalse(is_simple([[0, 1, 2, 3]], [(0, 0, 0), (2000, 0, 0), (0, 2000, 0), (2000, 2000, 0)]))
        self.assertEqual(faults_of([(0, 0), (2000, 0), (2000, 3000), (1000, -1), (0, 2000)])[0], "a face crosses itself")

    def test_an_edge_of_a_millimetre(self):
        self.assertEqual(faults_of([(0, 0), (2000, 0), (2000, 1000), (2000, 1002), (0, 2000)]), ["a face passes a corner twice"])

    def test_a_face_that_is_there_twice(self):
        faces, points = block([(0, 0), (2000, 0), (2000, 2000), (0, 2000)], 3000)
        self.assertIn("a face is there twice", list(faults([*faces, faces[1]], points, STEP)))

    def test_an_open_edge(self):
        faces, points = block([(0, 0), (2000, 0), (2000, 2000), (0, 2000)], 3000)
        self.assertEqual(list(faults(faces[:-1], points, STEP)), ["an edge is not passed once each way"])

    def test_two_fans_at_a_corner(self):
        fan = [[[0, 1, 2]], [[0, 2, 3]], [[0, 3, 1]]]
        other = [[[0, 4, 5]], [[0, 5, 6]], [[0, 6, 4]]]
        rest = [[[1, 3, 2]], [[4, 6, 5]]]
        self.assertTrue(has_one_fan(fan + rest[:1]))
        self.assertFalse(has_one_fan(fan + other + rest))

    def test_edges_and_faces(self):
        points = [(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0), (5, 5, -5), (5, 5, 5), (20, 20, -5), (20, 20, 5), (4, 4, 0), (6, 4, 0),
                  (6, 6, 0), (4, 6, 0), (2, 2, 0), (3, 3, 0)]
        square, pierced = [[0, 1, 2, 3]], [[0, 1, 2, 3], [8, 11, 10, 9]]
        self.assertTrue(crosses((4, 5), square, points))
        self.assertFalse(crosses((4, 5), pierced, points))
        self.assertFalse(crosses((6, 7), square, points))
        self.assertTrue(crosses((12, 13), square, points))
        self.assertTrue(is_within((0, 5), [[(0, 0), (10, 0), (10, 10), (0, 10)]]))


if __name__ == "__main__":
    unittest.main()

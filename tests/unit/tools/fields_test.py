"""XDMF series as arrays: particles and structured blocks."""

import pathlib
import tempfile
import unittest

import h5py
import numpy as np
import tools_path  # noqa: F401
from littoral_lib import fields, moment
from littoral_lib.errors import UserError

HEAD = '<Xdmf Version="3.0"><Domain><Grid GridType="Collection" CollectionType="Temporal">'
TAIL = "</Grid></Domain></Xdmf>"


def item(name, dims):
    return f'<DataItem Format="HDF" Dimensions="{dims}">a.h5:/{name}</DataItem>'


class Series(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, body, **arrays):
        with h5py.File(self.folder / "a.h5", "w") as file:
            for name, values in arrays.items():
                file[name] = values
        (self.folder / "a.xdmf").write_text(HEAD + body + TAIL)
        return fields.find_series(self.folder)

    def test_particles(self):
        x, p = np.arange(12.0).reshape(4, 3), np.arange(4.0)
        series = self.write('<Grid Name="g"><Time Value="0.5"/><Topology TopologyType="Polyvertex" '
                            f'NumberOfElements="4"/><Geometry>{item("x", "4 3")}</Geometry>'
                            f'<Attribute Name="p">{item("p", "4")}</Attribute>'
                            f'<Attribute Name="u">{item("x", "4 3")}</Attribute></Grid>', x=x, p=p)
        self.assertEqual(series[0].time, 0.5)
        np.testing.assert_array_equal(series[0].points, x)
        np.testing.assert_array_equal(series[0]["p"], p)
        self.assertEqual(series[0]["u"].shape, (4, 3))
        with self.assertRaises(UserError):
            series[0]["pressure"]

    def test_a_region_without_particles_has_empty_fields_of_their_kind(self):
        series = self.write('<Grid Name="g"><Time Value="0"/><Topology TopologyType="Polyvertex" '
                            f'NumberOfElements="0"/><Geometry>{item("x", "0 3")}</Geometry>'
                            f'<Attribute Name="pressure">{item("p", "0")}</Attribute>'
                            f'<Attribute Name="velocity">{item("x", "0 3")}</Attribute></Grid>',
                            x=np.zeros((0, 3)), p=np.zeros(0))
        self.assertEqual((series[0]["velocity"].shape, series[0]["pressure"].shape), ((0, 3), (0,)))
        self.assertEqual(moment.Part(series[0]).speed.shape, (0,))

    def test_bodies_are_not_the_water(self):
        (self.folder / "bodies.xdmf").write_text("their own series")
        self.assertEqual(fields.find_series(self.folder), [])
        (self.folder / "particles.xdmf").write_text(HEAD + '<Grid Name="g"><Time Value="2"/></Grid>' + TAIL)
        self.assertEqual([s.time for s in fields.find_series(self.folder)], [2.0])

    def test_cells_of_a_planar_block_have_centres(self):
        nodes = np.array([[[[i, j, k] for i in range(3)] for j in range(2)] for k in range(4)], float)  # nk nj ni
        p = np.arange(6.0)
        block = ('<Grid Name="b"><Topology TopologyType="3DSMesh" Dimensions="4 2 3"/>'
                 f'<Geometry>{item("x", "4 2 3 3")}</Geometry><Attribute Name="p" Center="Cell">{item("p", "3 1 2")}'
                 '</Attribute></Grid>')
        series = self.write('<Grid GridType="Collection" CollectionType="Spatial"><Time Value="1"/>' + block + "</Grid>",
                            x=nodes, p=p)
        self.assertEqual(len(series), 1)
        np.testing.assert_allclose(series[0].points[0], [0.5, 0.5, 0.5])
        np.testing.assert_allclose(series[0].points[3], [1.5, 0.5, 1.5])
        np.testing.assert_array_equal(series[0]["p"], p)


if __name__ == "__main__":
    unittest.main()

"""Worlds in SDF and URDF, and small grids of heights, that use what `echoloop import` knows."""
import struct

BOX = "<box><size>1 2 3</size></box>"
SHAPES = {
    "box": BOX, "sphere": "<sphere><radius>1</radius></sphere>", "plane": "<plane><normal>0 0 1</normal><size>4 2</size></plane>",
    "cylinder": "<cylinder><radius>1</radius><length>2</length></cylinder>",
    "cone": "<cone><radius>1</radius><length>2</length></cone>",
    "capsule": "<capsule><radius>1</radius><length>2</length></capsule>",
    "ellipsoid": "<ellipsoid><radii>1 2 3</radii></ellipsoid>",
    "polyline": "<polyline><point>0 0</point><point>2 0</point><point>0 2</point><height>1</height></polyline>",
    "mesh": "<mesh><uri>a.obj</uri><scale>1 2 -1</scale></mesh>",
    "heightmap": "<heightmap><uri>d.asc</uri><size>20 10 4</size><pos>0 0 -3</pos></heightmap>",
}


def visual(shape, more=""):
    return f'<visual name="v"><geometry>{shape}</geometry>{more}</visual>'


def model(content, more="", name="m1"):
    return f'<model name="{name}">{more}<link name="l">{content}</link></model>'


def world(content, version="1.7"):
    return f'<sdf version="{version}"><world name="w">{content}</world></sdf>'


def texts():
    for name, shape in SHAPES.items():
        yield name, world(model(visual(shape), "<static>true</static><pose>1 2 3 0 0 1</pose>"))
    yield "materials", world(model(visual(BOX, "<laser_retro>0.5</laser_retro><material><script><uri>x</uri>"
                                          "<name>Gazebo/Steel</name></script></material>")))
    yield "include", world("<include><uri>model://m</uri><name>a</name><pose>0 0 1 0 0 0</pose></include>"
                           '<frame name="f" attached_to="a"/>' + model(visual(BOX), '<pose relative_to="f">1 0 0 0 0 0</pose>'))
    yield "joints", world(model(visual(BOX), '<link name="k">' + visual(BOX) + '</link><joint name="j" type="revolute"><parent>l'
                                "</parent><child>k</child><axis><xyz>0 0 1</xyz></axis></joint>"), "1.11")
    yield "place", world("<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>59</latitude_deg>"
                         "<longitude_deg>10</longitude_deg><elevation>1</elevation><heading_deg>30</heading_deg>"
                         "</spherical_coordinates>" + model(visual(BOX) + '<sensor name="s" type="imu"/>'))
    yield "nested", world(model(visual(BOX), model(visual(BOX), name="m2")))
    yield "urdf", ('<robot name="r"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link><link name="b">'
                   '<visual><origin xyz="0 0 1" rpy="0 0 1"/><geometry><mesh filename="a.obj" scale="2 2 2"/></geometry></visual>'
                   '</link><joint name="j" type="fixed"><origin xyz="1 0 0"/><parent link="a"/><child link="b"/></joint></robot>')


def surfer(rows):
    """Surfer's binary grid."""
    flat = [z for row in rows for z in row]
    return (b"DSBB" + struct.pack("<2h6d", len(rows[0]), len(rows), 0, 4, 0, 4, min(flat), max(flat)) +
            struct.pack(f"<{len(flat)}f", *flat))


def geotiff(rows, bits=32, code="f"):
    """Uncompressed, in degrees; `code` is struct's."""
    width, height = len(rows[0]), len(rows)
    data = struct.pack(f"<{width * height}{code}", *[z for row in rows for z in row])
    scale, tie = struct.pack("<3d", 1e-4, 1e-4, 0), struct.pack("<6d", 0, 0, 0, 10.5, 59.4, 0)
    keys = struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326)
    tags = 13
    at = 8 + 2 + 12 * tags + 4
    entries = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, bits), (259, 3, 1, 1), (262, 3, 1, 1), (273, 4, 1, at),
               (277, 3, 1, 1), (278, 4, 1, height), (279, 4, 1, len(data)), (339, 3, 1, {"f": 3}.get(code, 2)),
               (33550, 12, 3, at + len(data)), (33922, 12, 6, at + len(data) + 24), (34735, 3, 16, at + len(data) + 72)]
    return (b"II*\0" + struct.pack("<I", 8) + struct.pack("<H", tags) + b"".join(struct.pack("<HHII", *e) for e in entries) +
            bytes(4) + data + scale + tie + keys)


def grids():
    rows = [[-10, -11, -12, -13], [-10.5, -11, -9999, -13], [-11, -10, -12, -14]]
    asc = "ncols 4\nnrows 3\nxllcorner 10\nyllcorner 59\ncellsize 0.001\nNODATA_value -9999\n"
    asc += "\n".join(" ".join(map(str, row)) for row in rows) + "\n"
    xyz = "".join(f"{500000 + 2 * c} {6580000 - 2 * r} {z}\n" for r, row in enumerate(rows) for c, z in enumerate(row) if z != -9999)
    yield "asc", b"\x09" + asc.encode()
    yield "xyz", b"\x0c" + xyz.encode()
    yield "surfer", b"\x0e" + surfer(rows)
    yield "surfer-text", b"\x0e" + b"DSAA\n4 3\n0 4\n0 4\n-14 -10\n" + "\n".join(" ".join(map(str, row)) for row in rows).encode()
    yield "geotiff", b"\x40" + geotiff(rows)
    yield "geotiff-16", b"\x40" + geotiff([[int(z) for z in row] for row in rows], 16, "h")


def worlds():
    """(folder, name, bytes)"""
    for name, text in texts():
        for way in b"\0\1":
            yield "world", f"{name}-{way}", bytes([way]) + text.encode()
    for name, data in grids():
        yield "grid", name, data

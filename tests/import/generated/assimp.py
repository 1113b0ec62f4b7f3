"""Formats that assimp reads, and RAW, which it read wrong."""
import struct

from .claims import SQUARE_BOUNDS

RAW = "0 0 0 2 0 0 2 2 0\n"
ASE = """*3DSMAX_ASCIIEXPORT 200
*GEOMOBJECT {{
*NODE_NAME "square"
*MESH {{
*MESH_NUMVERTEX 4
*MESH_NUMFACES 2
*MESH_VERTEX_LIST {{
*MESH_VERTEX 0 0 0 0
*MESH_VERTEX 1 2 0 0
*MESH_VERTEX 2 2 2 0
*MESH_VERTEX 3 0 2 0
}}
*MESH_FACE_LIST {{
*MESH_FACE 0: A: 0 B: 1 C: 2 AB: 1 BC: 1 CA: 0
*MESH_FACE 1: A: 0 B: {} C: 3 AB: 1 BC: 1 CA: 0
}}
}}
}}
"""
OGRE = ('<mesh><submeshes><submesh material="m" usesharedvertices="false" operationtype="triangle_list"><faces count="2">'
        '<face v1="0" v2="1" v3="2"/><face v1="0" v2="2" v3="{}"/></faces><geometry vertexcount="4">'
        '<vertexbuffer positions="true" normals="false"><vertex><position x="0" y="0" z="0"/></vertex>'
        '<vertex><position x="2" y="0" z="0"/></vertex><vertex><position x="2" y="2" z="0"/></vertex>'
        '<vertex><position x="0" y="2" z="0"/></vertex></vertexbuffer></geometry></submesh></submeshes></mesh>')
SMD = ("version 1\nnodes\n0 \"r\" -1\nend\nskeleton\ntime 0\n0 0 0 0 0 0 0\nend\ntriangles\n"
       "m\n0 0 0 0 0 0 1 0 0\n0 2 0 0 0 0 1 0 0\n0 2 2 0 0 0 1 0 0\nend\n")
DXF_FACE = "0\n3DFACE\n8\n0\n" + "".join(f"1{i}\n{x}\n2{i}\n{y}\n3{i}\n0\n" for i, (x, y) in enumerate([(0, 0), (2, 0), (2, 2), (0, 2)]))
X = "xof 0303txt 0032\nMesh m {{\n4;\n0;0;0;,\n2;0;0;,\n2;2;0;,\n0;2;0;;\n2;\n3;0,1,2;,\n3;0,2,{};;\n}}\n"
AC = ('AC3Db\nMATERIAL "" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\nOBJECT poly\n'
      "numvert 4\n0 0 0\n2 0 0\n2 2 0\n0 2 0\nnumsurf {}\n"
      "SURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n2 0 0\n3 0 0\nkids 0\n")
COLLADA = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="m"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="pa" count="12">0 0 0 2 0 0 2 2 0 0 2 0</float_array><technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="2">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/>{}</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
AMF = ('<?xml version="1.0"?><amf{}><object id="0"><mesh><vertices>' + "".join(
    f"<vertex><coordinates><x>{x}</x><y>{y}</y><z>0</z></coordinates></vertex>" for x, y in ((0, 0), (2, 0), (2, 2), (0, 2))) +
       "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle>"
       "<triangle><v1>0</v1><v2>2</v2><v3>3</v3></triangle></volume></mesh></object></amf>")


def lwo(*lists):
    def chunk(name, data):
        return name + struct.pack(">I", len(data)) + data + b"\0" * (len(data) % 2)

    corners = b"".join(struct.pack(">3f", *corner) for corner in ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)))
    form = b"LWO2" + chunk(b"TAGS", b"a\0") + chunk(b"LAYR", struct.pack(">HH3f", 0, 0, 0, 0, 0) + b"l\0") + chunk(b"PNTS", corners)
    for kind, faces in lists:
        form += chunk(b"POLS", kind + b"".join(struct.pack(f">{len(face) + 1}H", len(face), *face) for face in faces))
    return b"FORM" + struct.pack(">I", len(form)) + form


def fbx(second, up=1):
    def mesh(number, vertices):
        return (f'\tGeometry: {number}, "Geometry::g", "Mesh" {{\n\t\tVertices: *{vertices.count(",") + 1} {{\n\t\t\ta: {vertices}\n\t\t}}\n'
                f'\t\tPolygonVertexIndex: *3 {{\n\t\t\ta: 0,1,-3\n\t\t}}\n\t}}\n\tModel: {number + 1}, "Model::m", "Mesh" {{\n\t\tVersion: 232\n\t}}\n')

    return ("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\nGlobalSettings:  {\n\tVersion: 1000\n"
            '\tProperties70:  {\n\t\tP: "UpAxis", "int", "Integer", "",' + str(up) + '\n\t\tP: "UnitScaleFactor", "double", "Number", "",100\n\t}\n}\n'
            "Objects:  {\n" + mesh(100, "0,0,0,2,0,0,2,2,0") + mesh(200, second) + "}\nConnections:  {\n" +
            "".join(f'\tC: "OO",{i + 1},0\n\tC: "OO",{i},{i + 1}\n' for i in (100, 200)) + "}\n")


def assimp(claims):
    """Formats that assimp reads, and RAW, which it read wrong."""
    def square(claim, name, content, warnings=(), triangles=2, **options):
        is_turned = name.endswith((".ase", ".dxf"))  # from +Z up
        claims.bakes(claim, name, content, triangles, ([0, 0, -2], [2, 0, 0]) if is_turned else SQUARE_BOUNDS, warnings, **options)

    def warns(claim, name, content, kinds, *options, metres=None):
        """The file bakes with warnings of these kinds alone, and its unit is so many metres if that is stated."""
        claims.write(name, content)
        code, document, stderr = claims.run(name, *options)
        found = [warning["kind"] for warning in document.get("warnings", [])]
        claims.check(claim, code == 0 and found == kinds, (found, stderr))
        if metres is not None:
            claims.check(claim, code == 0 and document["inputs"][0]["metres_per_unit"] == metres, (document, stderr))

    square("reports: a whole Collada is baked without a warning", "node.dae", COLLADA.format(""))
    for name, node in (("missing", "#zz"), ("external", "other.dae#zz")):
        square(f"reports: a {name} node of Collada is warned of", "node.dae", COLLADA.format(f'<instance_node url="{node}"/>'),
               ["importer_report"])
    square("reports: a missing block of DXF is warned of", "block.dxf",
           "0\nSECTION\n2\nENTITIES\n" + DXF_FACE + "0\nINSERT\n2\nBLK\n10\n5\n20\n5\n30\n5\n0\nENDSEC\n0\nEOF\n", ["importer_report"])
    square("reports: a whole AC3D is baked without a warning", "square.ac", AC.format(2))
    warns("reports: two meshes of FBX are baked without a warning", "two.fbx", fbx("9,0,0,8,0,0,8,2,0"), [])
    for name, vertices in (("floats that are no multiple of three", "9,0,0,8,0,0,8,2"), ("a word among the floats", "9,x,0,8,0,0,8,2,0")):
        claims.write("two.fbx", fbx(vertices))
        code, document, _ = claims.run("two.fbx")
        kinds = [warning["kind"] for warning in document.get("warnings", [])]
        claims.check(f"reports: {name} of FBX are warned of", code != 0 or "importer_report" in kinds, document)

    square("RAW: nine numbers are a triangle", "square.raw", RAW + "0 0 0 2 2 0 0 2 0\n", format="RAW")
    square("RAW: groups are meshes, and a texture is skipped", "group.raw", "one\n" + RAW + "two\n0 0 0 2 2 0 0 2 0 a b.png\n", meshes=2)
    claims.bakes("RAW: .5 is a half", "half.raw", ".5 0 0 2.5 0 0 2 2 -.5\n", 1, ([0.5, 0, -0.5], [2.5, 2, 0]))
    square("RAW: twelve numbers begin with a colour and are warned of", "colour.raw", "1 .5 1 " + RAW, ["colour_or_corner"], triangles=1)
    for name, line, words in (("eight numbers", "0 0 0 9 0 0 0 9", "8 numbers"), ("a word", "0 0 0 9 0 0 0 x 0", "'x'"),
                              ("commas", "0,0,0,9,0,0,0,9,0 0", "'0,0,0,9,0,0,0,9,0'"), ("13 numbers", "1 1 1 " + RAW[:-1] + " 3", "more than"),
                              ("numbers behind a word", RAW[:-1] + " tex 5 5 5", "'5'"), ("a comma behind nine", RAW[:-1] + " 0,0", "'0,0'"),
                              ("a number behind a texture of twelve", "1 1 1 " + RAW[:-1] + " tex 5", "more than")):
        claims.refuses(f"RAW: a line with {name} is refused", "line.raw", RAW + line + "\n", "line 2", words)

    square("ASE: a whole file is baked without a warning", "square.ase", ASE.format(2))
    for index in (4, 9):
        claims.refuses(f"ASE: vertex {index} of four is refused with its line", "index.ase", ASE.format(index), "line 15", f"vertex {index}")
    square("Ogre: a whole file is baked without a warning", "square.mesh.xml", OGRE.format(3))
    for index in (4, 9):
        claims.refuses(f"Ogre: vertex {index} of four is refused", "index.mesh.xml", OGRE.format(index), f"vertex {index}")
    square("X: a whole file is baked without a warning", "square.x", X.format(3))
    warns("X: a face with a missing vertex is warned of", "index.x", X.format(9), ["empty_face"])
    square("LWO: one list of polygons is baked without a warning", "square.lwo", lwo((b"FACE", [(0, 1, 2), (0, 2, 3)])))
    claims.refuses("LWO: two lists of polygons are refused", "two.lwo", lwo((b"FACE", [(0, 1, 2)]), (b"FACE", [(0, 2, 3)])), "POLS", "glTF")

    end = "0\nENDSEC\n0\nEOF\n"
    dxf = "0\nSECTION\n2\nENTITIES\n" + DXF_FACE
    square("DXF: a whole file is baked without a warning", "end.dxf", dxf + end)
    square("DXF: a missing EOF is warned of", "end.dxf", dxf + end.replace("EOF\n", ""), ["missing_end"])
    for text, warnings in ((SMD, []), (SMD[:-4], ["missing_end"])):
        warns("SMD: a missing end is warned of", "end.smd", text, warnings)

    for unit, metres in (("", 0.001), (' unit="inch"', 0.0254), (' version="1.1" unit="meter"', 1)):
        warns(f"AMF: the unit of <amf{unit}> is read", "unit.amf", AMF.format(unit), [], metres=metres)
    for options, warnings in (((), ["up_axis_kept"]), (("--up", "z"), [])):
        warns("FBX: an up axis that was kept is warned of", "up.fbx", fbx("9,0,0,8,0,0,8,2,0", 2), warnings, *options)
    square("names: an ending without an importer is warned of if the content has one", "square.model", AC.format(2), ["unknown_ending"])
    skeleton = SMD[:SMD.index("triangles")]
    warns("SMD: a skeleton alone is an incomplete scene", "skeleton.smd", skeleton, ["incomplete_scene"], "--allow-empty")
    claims.refuses("SMD: a skeleton alone is refused with the cause", "skeleton.smd", skeleton, "incomplete", "--allow-empty")
    claims.refuses("LWO: splines alone are refused", "spline.lwo", lwo((b"CURV", [(0, 1, 2), (0, 2, 3)])), "No meshes")
    square("AC3D: more surfaces than stated are warned of", "square.ac", AC.format(1), ["surface_count"], triangles=1)
    square("AC3D: fewer vertices than stated are warned of", "square.ac", AC.format(2).replace("numvert 4", "numvert 5"), ["importer_report"])
    warns("AC3D: a missing vertex is warned of", "square.ac", AC.format(2).replace("3 0 0\nkids", "9 0 0\nkids"),
          ["importer_report"], "--max-dropped", "50")
    claims.refuses("AMF: an unknown unit is refused", "unit.amf", AMF.format(' unit="ell"'), "ell")

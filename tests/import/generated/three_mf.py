"""3MF."""
import io
import json
import struct
import subprocess
import zipfile
from unittest import mock

from .claims import BOX, BOX_BOUNDS, TRIANGLES, check_materials

MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = 'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p"'


def mesh(corners=BOX, triangles=TRIANGLES, more=""):
    vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in corners)
    return (f"<mesh><vertices>{vertices}</vertices><triangles>" +
            "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles) + f"</triangles>{more}</mesh>")


def thing(number, content=mesh(), attributes=""):
    return f'<object id="{number}" {attributes}>{content}</object>'


def parts(*uses):
    """Components: the numbers of objects, or numbers and attributes."""
    pairs = [use if isinstance(use, tuple) else (use, "") for use in uses]
    return "<components>" + "".join(f'<component objectid="{number}" {more}/>' for number, more in pairs) + "</components>"


def moved(x=0, y=0, z=0, linear="1 0 0 0 1 0 0 0 1"):
    return f'transform="{linear} {x} {y} {z}"'


def model(resources=thing(1), items='<item objectid="1"/>', attributes='unit="meter"'):
    return (f'<?xml version="1.0" encoding="UTF-8"?><model {attributes} xmlns="{CORE}">'
            f"<resources>{resources}</resources><build>{items}</build></model>")


def relationship(target="/3D/3dmodel.model", kind=MODEL_TYPE, more=""):
    return f'<Relationship Type="{kind}" Target="{target}" Id="r" {more}/>'


def package(content=model(), path="3D/3dmodel.model", relationships=relationship(), more=(), method=zipfile.ZIP_DEFLATED, wide=False):
    file = io.BytesIO()
    with mock.patch("zipfile.ZIP64_LIMIT", 1 if wide else zipfile.ZIP64_LIMIT), zipfile.ZipFile(file, "w", method) as archive:
        listed = [("[Content_Types].xml", "<Types/>"), (path, content)]
        if relationships is not None:
            listed.append(("_rels/.rels", f'<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">{relationships}</Relationships>'))
        for name, data in listed + list(more):
            archive.writestr(name, data)
    return file.getvalue()


def changed(content, record, offset, number, form="<I"):
    """The archive with another number in the last of its records with that mark."""
    at = content.rindex(record) + offset
    return content[:at] + struct.pack(form, number) + content[at + struct.calcsize(form):]


def check_volume(claims, claim, expected):
    answer = subprocess.run([claims.espalier, "query", claims.blob, "triangles", "--json"], capture_output=True, check=False)
    total = 0.0
    for triangle in json.loads(answer.stdout or b"{}").get("triangles", []):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (triangle[corner] for corner in "abc")
        total += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6
    claims.check(claim, abs(total - expected) < 1e-3 * abs(expected), f"volume {total}, not {expected}")


def three_mf(claims):
    def box(claim, content, name="box.3mf", **options):
        claims.bakes("3MF: " + claim, name, content, 12, BOX_BOUNDS, closed=True, format="3MF", **options)

    def boxes(claim, content, count, bounds, volume=None, **options):
        document = claims.bakes("3MF: " + claim, "boxes.3mf", content, 12 * count, bounds, **options)
        if volume is not None:
            check_volume(claims, "3MF: " + claim, volume)
        return document

    box("a plain one", package())
    box("stored without packing", package(method=zipfile.ZIP_STORED))
    box("sizes of 64 bits", package(wide=True))
    box("a comment behind the archive", package()[:-2] + b"\x07\0comment")
    box("a file without relationships", package(relationships=None))
    box("a model at another path", package(path="3D/Other.Model", relationships=relationship("3D/other.model")))
    box("one without its ending", package(), name="package")
    box("--format reads one by any name", package(path="x.model", relationships=relationship("x.model")), name="p.zip", options=["--format", "3mf"])
    picture = relationship("/Metadata/t.png", "http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail")
    for links in (picture + relationship(), relationship() + picture, relationship() + relationship("http://x", more='TargetMode="External"')):
        box("a thumbnail and links to elsewhere have no effect", package(relationships=links, more=[("Metadata/t.png", b"\x89PNG\r\n\x1a\n\0")]))
    for unit, metres in (("micron", 1e-6), ("millimeter", 0.001), ("centimeter", 0.01), ("inch", 0.0254), ("foot", 0.3048), ("meter", 1), ("", 0.001)):
        for options, expected in (((), metres), (("--unit", "km"), 1000)):
            claims.write("unit.3mf", package(model(attributes=unit and f'unit="{unit}"')))
            _, document, stderr = claims.run("unit.3mf", "--expect-size", "0..1e9", *options)
            claims.check(f"3MF: the unit '{unit}' is read and --unit comes before it", document.get("warnings") == [] and
                         document["inputs"][0]["metres_per_unit"] == expected, (document, stderr))

    group = thing(1) + thing(2, parts(1, (1, moved(10, 0, 5, "0 1 0 -1 0 0 0 0 1"))))
    boxes("components and items are placed by rows of a matrix, one after the other", package(model(group, f'<item objectid="2" {moved(0, 0, 7)}/>')), 2,
          ([0, 0, 7], [10, 2, 16]), volume=16, meshes=2)
    boxes("a mirrored item keeps its front outside", package(model(thing(1), f'<item objectid="1" {moved(linear="-1 0 0 0 1 0 0 0 1")}/>')), 1,
          ([-1, 0, 0], [0, 2, 4]), volume=8)
    boxes("an item that is mirrored twice too", package(model(thing(1) + thing(2, parts((1, moved(linear="-1 0 0 0 1 0 0 0 1")))),
                                                              f'<item objectid="2" {moved(linear="1 0 0 0 -2 0 0 0 1")}/>')), 1, ([-1, -4, 0], [0, 0, 4]), volume=16)
    away = [("3D/Objects/a.model", model(thing(1), '<item objectid="1" transform="9 0 0 0 9 0 0 0 9 0 0 0"/>'))]
    for attribute, resources in ((f'p:path="/3D/Objects/a.model" objectid="1" {moved(1)}', ""), ('objectid="8" transform="1 0 0 0 1 0 0 0 1 1 0 0"',
                                 thing(8, parts((1, 'p:path="/3D/Objects/a.model"'))))):
        boxes("objects of other models are found by their path, and the builds of those are ignored",
              package(model(resources, f"<item {attribute}/>", f'unit="meter" {PRODUCTION}'), more=away), 1, ([1, 0, 0], [2, 2, 4]))
    claims.refuses("3MF: another unit in another model is refused", "units.3mf",
                   package(model("", '<item p:path="/3D/Objects/a.model" objectid="1"/>', PRODUCTION), more=away), "3D/Objects/a.model", "meter", "millimeter")
    kinds = [thing(i, attributes=f'type="{kind}"') for i, kind in enumerate(("model", "support", "solidsupport", "surface", "other"), 1)]
    boxes("supports and surfaces are baked, and an object of type other is warned of", package(model("".join(kinds) + thing(9, parts(1, 2, 3, 4, 5)),
          '<item objectid="9"/>')), 1, BOX_BOUNDS, warnings=["object_left_out"], meshes=4)
    boxes("objects that the build does not place are warned of", package(model(thing(1) + thing(2) + thing(3))), 1, BOX_BOUNDS, warnings=["unused_mesh"])
    placed = package(model(thing(1), "".join(f'<item objectid="1" {moved(3 * i)}/>' for i in range(9))))
    claims.write("placed.3mf", placed)
    code, document, stderr = claims.run("placed.3mf", "--instances", "all")
    claims.check("3MF: an object that is placed often is one mesh of a scene", (document.get("instance_count"), document.get("mesh_count")) == (9, 1), (document, stderr))
    code, _, stderr = claims.run("placed.3mf", "--deformable", "--range", "0", "0", "0", "99", "9", "9")
    claims.check("3MF: vertices keep their order", code == 0, stderr)

    bases = '<basematerials id="5"><base name="a"/><base name="b"/></basematerials><basematerials id="6"><base name="c"/></basematerials>'
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 1, 3)]
    faces = [("0 1 2", ""), ("0 2 3", 'p1="0"'), ("0 1 4", 'pid="6" p1="0"'), ("1 2 4", 'pid="7" p1="0"')]
    coloured = "".join('<triangle v1="{}" v2="{}" v3="{}" {}/>'.format(*numbers.split(), more) for numbers, more in faces)
    claims.bakes("3MF: base materials are numbered from 1 in the order of the file", "bases.3mf", package(model(
        bases + thing(1, mesh(corners, []).replace("<triangles>", "<triangles>" + coloured), 'pid="5" pindex="1"'))), 4, ([0, 0, 0], [2, 2, 3]))
    check_materials(claims, "3MF: base materials are numbered from 1 in the order of the file", "bases.3mf", [2, 1, 3, 0])

    def extended(name, required, more=""):
        uses = 'requiredextensions="x"' if required else ""
        return package(model(thing(1, mesh(more=more)), attributes=f'unit="meter" xmlns:x="http://schemas.example.org/{name}/2030/01" {uses}'))

    for name in ("beamlattice", "booleanoperations", "displacement", "implicit", "volumetric", "securecontent", "slice"):
        claims.refuses(f"3MF: the required extension {name} is refused", "extended.3mf", extended(name, True), "requires", "not read")
        box(f"{name} that is not required is warned of where it adds geometry", extended(name, False, "<x:a><x:b/></x:a><x:a/>"),
            warnings=[] if name == "slice" else ["extension_left_out"])
    for name, warnings in (("material", []), ("production", []), ("trianglesets", []), ("unheard", ["unknown_extension"])):
        box(f"the required extension {name} is read", extended(name, True, "<x:a><mesh/></x:a>"), warnings=warnings)

    deep = thing(1) + "".join(thing(i, parts(i - 1)) for i in range(2, 50000))
    boxes("objects nest to any depth", package(model(deep, '<item objectid="49999"/>')), 1, BOX_BOUNDS)
    doubled = thing(1) + "".join(thing(i, parts(i - 1, i - 1)) for i in range(2, 90))
    hollow = doubled.replace(mesh(), mesh([], []))
    claims.refuses("3MF: a mesh that is placed 2^88 times is refused before memory is taken", "doubled.3mf", package(model(doubled, '<item objectid="89"/>')), "1048576 copies")
    claims.refuses("3MF: nothing that is placed 2^88 times is an empty file", "hollow.3mf", package(model(hollow, '<item objectid="89"/>')), "no triangles")
    for number in ("8", "-1", "99999999999"):
        odd = package(model(thing(1, mesh().replace('v3="6"', f'v3="{number}"', 1), 'name="gear"')))
        claims.refuses("3MF: a missing vertex is refused with its object and triangle", "odd.3mf", odd, "object 1 (gear)", "triangle 7", f"vertex {number}", "8 vertices")
    claims.bakes("3MF: --drop-bad-triangles drops triangles whose vertices are missing, with a warning", "odd.3mf", odd, 11, BOX_BOUNDS, ["missing_vertex"],
                 options=["--drop-bad-triangles"])

    whole = package()
    line = "\n" * 6
    for claim, content, words in (
            ("an archive that is cut off", whole[:-30], "cut off"), ("an archive that begins later", whole[40:], "list of files"),
            ("a list beyond the file", changed(whole, b"PK\5\6", 16, 10**6), "list of files"), ("more files than listed", changed(whole, b"PK\5\6", 10, 9, "<H"), "list of files"),
            ("a damaged file", changed(whole, b"PK\1\2", 16, 7), "damaged"), ("a file with another size", changed(whole, b"PK\1\2", 24, 99), "damaged"),
            ("a file of more bytes than fit", changed(whole, b"PK\1\2", 24, 2**31), "more bytes"), ("an encrypted file", changed(whole, b"PK\1\2", 8, 1, "<H"), "encrypted"),
            ("another packing", changed(whole, b"PK\1\2", 10, 14, "<H"), "method 14"), ("a packed size beyond the file", changed(whole, b"PK\1\2", 20, 2**31), "cut off"),
            ("a file twice", package(more=[("/3d/3DMODEL.model", "<model/>")]), "twice"),
            ("no model", package(path="other.model"), "3D/3dmodel.model"), ("two models", package(relationships=relationship() + relationship("/b.model")), "/b.model"),
            ("a missing model of another object", package(model("", '<item p:path="/c.model" objectid="1"/>', PRODUCTION)), "c.model"),
            ("a document type", package(model().replace("<model", '<!DOCTYPE m [<!ENTITY e "x">]><model', 1)), "document type"),
            ("XML that ends early", package(line + model()[40:-9]), "line 7"), ("another root", package(model().replace("model", "figure")), "'figure'"),
            ("an unknown unit", package(model(attributes='unit="ell"')), "'ell'"), ("an unknown type", package(model(thing(1, attributes='type="x"'))), "'x'"),
            ("an object twice", package(model(thing(1) + thing(1))), "id 1"), ("an object without id", package(model("<object/>")), "id = ''"),
            ("a missing object", package(model(items='<item objectid="2"/>')), "build item 0: it names object 2"),
            ("a missing component", package(model(thing(1, parts(7)))), "component 0: it names object 7"), ("an object in itself", package(model(thing(1, parts(1)))), "contains itself"),
            ("a circle", package(model(thing(1, parts(2)) + thing(2, parts(3)) + thing(3, parts(1)))), "contains itself"),
            ("a coordinate that is none", package(line + model()[39:].replace('x="0"', 'x="1,5"', 1)), "line 7"), ("no coordinate", package(model().replace('x="0"', "", 1)), "x = ''"),
            ("a corner that is none", package(model().replace('v1="0"', 'v1="0.5"', 1)), "v1 = '0.5'"), ("a short transform", package(model(items='<item objectid="1" transform="1 0 0"/>')), "twelve"),
            ("a long transform", package(model(items=f'<item objectid="1" {moved(z="0 0")}/>')), "twelve"), ("a transform to nowhere", package(model(items=f'<item objectid="1" {moved("inf")}/>')), "finite"),
            ("a base material that is missing", package(model(bases + thing(1, attributes='pid="6" pindex="1"'))), "pindex")):
        claims.refuses(f"3MF: {claim} is refused", "bad.3mf", content, words)

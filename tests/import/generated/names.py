"""Files whose names and contents do not agree."""


def names(claims):
    claims.refuses("names: an ending without an importer is named", "scene.wrl", "#VRML V2.0 utf8\nShape { v f }\n", "no importer for '.wrl' files")
    claims.refuses("names: a file without an ending or a known content is refused", "readme", "vertex v f usemtl\n", "no ending")
    claims.refuses("names: a binary format without an importer is not taken for OBJ", "model.m3d", b"3DMO\x10\0\0\0v f \n\0v 1 2 3\n", "no importer for '.m3d'")
    claims.refuses("names: an empty file is refused", "empty.3ds", "", "is empty")
    collada = "<?xml version=\"1.0\" encoding=\"utf-16\"?><COLLADA version=\"1.4.1\"><asset/></COLLADA>"
    claims.refuses("names: a broken file is refused without a guess about its name", "broken.dae", collada[:40], "cannot be imported")

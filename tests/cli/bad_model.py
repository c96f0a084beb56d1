"""Models that must be refused, those among them that crash or exhaust readers of such files, and what is missing of others."""
import pathlib
import zipfile

from program import Checks, Program, skip

program, checks = Program(), Checks()
(program.folder / "empty.obj").write_text("")
(program.folder / "text.obj").write_text("no vertices here\n" * 100)
(program.folder / "binary.glb").write_bytes(b"glTF" + bytes(range(256)) * 64)
(program.folder / "picture.obj").write_bytes((program.folder / "panel.png").read_bytes())
(program.folder / "unknown.xyz").write_text("0 0 0\n")
(program.folder / "nan.obj").write_text("v nan 0 0\nv inf 1 0\nv 0 1 1\nf 1 2 3\n")
(program.folder / "index.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 999999999\n")
for model in ["none.obj", "empty.obj", "text.obj", "binary.glb", "picture.obj", "unknown.xyz", "nan.obj", "index.obj", "."]:
    checks.refused(program, model, f"eia tiny.toml --model {model} -o out.png", model)
checks.refused(program, "missing model for render", "render tiny.toml --model none.obj -o out.png", "none.obj")
checks.refused(program, "missing model of the description", "photo tiny.toml --set content.model=none.obj -o out.png", "none.obj")
checks.refused(program, "no reader", "photo tiny.toml --model pyramid.obj -o out.png", "lfdsim-model-reader", code=1,
               env={"LFDSIM_MODEL_READER": "/none"})

# What the library says of a file that it reads in vain is said in words of this program.
triangle = bytes(80) + (1).to_bytes(4, "little") + bytes(50)
for name, content, says in [("short.stl", b"solid" + triangle[5:-3], "it must have 134 bytes; it has 131"),
                            ("lying.stl", b"solid" + triangle[5:80] + (4000000000).to_bytes(4, "little") + triangle[84:], "names 4000000000 triangles"),
                            ("empty.stl", b"solid x\nendsolid x\n", "has no triangles: nothing to show"),
                            ("split.off", b"OFF\n3 1 0\n0 0 0\n1 0 # height\n0\n0 1 0\n3 0 1 2\n", "has text where a number is expected"),
                            ("none.3mf", b"PK\3\4" + bytes(200), "is damaged, or not of the format that its name states")]:
    (program.folder / name).write_bytes(content)
    checks.refused(program, name, f"photo tiny.toml --model {name} -o out.png", says)
(program.folder / "plain.obj").write_text("mtllib /etc/none.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n")
code, _, err = program.run("photo tiny.toml --model plain.obj -o out.png")
checks.that(code == 0 and err.count("warning") == 1 and "not found in the model's folder: shown without its colours" in err, f"no .mtl: {code} {err}")

# Of many textures that are missing the first are named, the others counted.
(program.folder / "bare.mtl").write_text("".join(f"newmtl m{k}\nmap_Kd none{k}.png\n" for k in range(40)))
(program.folder / "bare.obj").write_text("mtllib bare.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n" +
                                         "".join(f"usemtl m{k}\nf 1/1 2/2 3/3\n" for k in range(40)))
code, _, err = program.run("photo tiny.toml --model bare.obj -o bare.png")
checks.that(code == 0 and err.count("left out, shown grey") == 6 and "35 more textures left out" in err, f"40 missing textures: {code} {err}")

# What the reader of 3MF passes over is said; what it cannot take is not called damaged.
def write_3mf(name, resources, build, compression=zipfile.ZIP_DEFLATED, of_model=""):
    with zipfile.ZipFile(program.folder / name, "w", compression) as archive:
        archive.writestr("_rels/.rels", '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                         '<Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
                         '</Relationships>')
        archive.writestr("3D/3dmodel.model", '<?xml version="1.0"?><model unit="millimeter" '
                         'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" '
                         f'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" {of_model}>'
                         f'<resources>{resources}</resources><build>{build}</build></model>')


def square_3mf(colour, of_object="", last=3):
    corners = "".join(f'<vertex x="{x}" y="0" z="{z}"/>' for x, z in [(-1, -1), (1, -1), (1, 1), (-1, 1)])
    return (f'<object id="1" type="model" {of_object}><mesh><vertices>{corners}</vertices><triangles><triangle v1="0" v2="1" v3="2" {colour}/>'
            f'<triangle v1="0" v2="2" v3="{last}"/></triangles></mesh></object>')


red = '<basematerials id="2"><base name="red" displaycolor="#FF0000"/></basematerials>'
item = '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 691000.3 5334000.2 7"/>'
for name, resources, note in [("plain.3mf", square_3mf(""), ""), ("red.3mf", red + square_3mf("", 'pid="2" pindex="0"'), ""),
                              ("bare.3mf", red + square_3mf(""), "missing materials of 3MF objects (they get the file's first) are not shown"),
                              ("nowhere.3mf", red + square_3mf("", 'pid="9" pindex="0"'), "missing materials of 3MF objects (they get the file's first) are not shown"),
                              ("group.3mf", '<m:colorgroup id="2"><m:color color="#FF0000"/></m:colorgroup>' + square_3mf('pid="2" p1="0"'),
                               "colours of 3MF colour groups and materials of single triangles of 3MF are not shown")]:
    write_3mf(name, resources, item)
    code, _, err = program.run(f"photo tiny.toml --model {name} -o 3mf.png")
    checks.that(code == 0 and note in err and ("warning" in err) == bool(note), f"{name}: {code} {err}")
# A required extension is refused by its name, unless it is read, or what it adds is noted.
for of_model, refused in [('requiredextensions="m"', ""), ('xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p m"', ""),
                          ('xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"\n requiredextensions="m b"', "beamlattice"),
                          ("xmlns:zz='http://example.com/production/zz' requiredextensions = 'zz'", "http://example.com/production/zz"), ('requiredextensions=" q "', "extension q,")]:
    write_3mf("required.3mf", square_3mf(""), item, of_model=of_model)
    if refused:
        checks.refused(program, of_model, "photo tiny.toml --model required.3mf -o 3mf.png", refused, "which is not read")
    else:
        program.must("photo tiny.toml --model required.3mf -o 3mf.png")
# Numbers of OBJ that begin with a point.
for name, zero in ("point.obj", ""), ("digit.obj", "0"):
    (program.folder / name).write_text(f"v -{zero}.5 -{zero}.5 {zero}.0\nv {zero}.5 -{zero}.5 0\nv +{zero}.5 \\\n{zero}.5 0\nvt {zero}.5 {zero}.25\nf 1/1 2/1 3/1\n")
    program.must(f"photo tiny.toml --model {name} --size 60x40 -o {name}.npy")
checks.that((program.folder / "point.obj.npy").read_bytes() == (program.folder / "digit.obj.npy").read_bytes(), "OBJ: .5 is not 0.5")
# Hundreds of thousands of triangles before the only one with a material are searched once.
strip = range(200000)
corners, triangles = "".join(f'<vertex x="{i}" y="0" z="{i % 2}"/>' for i in strip), "".join(f'<triangle v1="{i}" v2="{i + 1}" v3="{i + 2}"/>' for i in strip[:-2])
write_3mf("many.3mf", f'{red}<object id="3"><mesh><vertices>{corners}</vertices><triangles>{triangles}</triangles></mesh></object>'
          + square_3mf('pid="2" p1="0"', 'pid="2" pindex="0"'), item, zipfile.ZIP_STORED)
code, _, err = program.run("photo tiny.toml --model many.3mf -o 3mf.png")
checks.that(code == 0 and "materials of single triangles" in err, f"many.3mf: {code} {err}")
write_3mf("vertex.3mf", square_3mf("", last=9), item)
checks.refused(program, "a face beyond the vertices", "photo tiny.toml --model vertex.3mf -o 3mf.png", "indices of vertices that do not exist")
for index in "1", "3", "100000", "-1", "x":
    write_3mf("material.3mf", red + square_3mf("", f'pid="2" pindex="{index}"'), item)
    checks.refused(program, f"material {index} of one", "photo tiny.toml --model material.3mf -o 3mf.png", "a material that does not exist")
write_3mf("itself.3mf", '<object id="2" type="model"><components><component objectid="2"/></components></object>', '<item objectid="2"/>')
checks.refused(program, "a part of itself", "photo tiny.toml --model itself.3mf -o 3mf.png", "save it in another format")

broken = pathlib.Path("/usr/share/assimp/models/glTF2")
names = ["IndexOutOfRange/AllIndicesOutOfRange.gltf", "IndexOutOfRange/IndexOutOfRange.gltf",
         "BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "RecursiveNodes/RecursiveNodes.gltf", "MissingBin/BoxTextured.gltf",
         "SchemaFailures/sceneWrongType.gltf"]
models = [broken / name for name in names if (broken / name).exists()]
if checks.wrong == 0 and not models:
    skip("the broken models of assimp-testmodels are not installed")
for model in models:
    checks.refused(program, model.name, f"eia tiny.toml --model {model} -o out.png", model.name)
checks.finish()

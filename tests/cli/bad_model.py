"""Models that must be refused, those among them that crash or exhaust readers of such files, and what is missing of others."""
import pathlib

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

# Of many textures that are missing the first are named, the others counted.
(program.folder / "bare.mtl").write_text("".join(f"newmtl m{k}\nmap_Kd none{k}.png\n" for k in range(40)))
(program.folder / "bare.obj").write_text("mtllib bare.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n" +
                                         "".join(f"usemtl m{k}\nf 1/1 2/2 3/3\n" for k in range(40)))
code, _, err = program.run("photo tiny.toml --model bare.obj -o bare.png")
checks.that(code == 0 and err.count("left out, shown grey") == 6 and "35 more textures left out" in err, f"40 missing textures: {code} {err}")

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

"""A picture that cannot be written to its end is exit code 1, and no part of it stays. A limit on file size stands in for the disk."""
import resource

from program import Checks, Program

program, checks = Program(), Checks()
LIMIT = 4096  # bytes; the pictures below take more


def limited():
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))


options = {"preexec_fn": limited}  # SIGXFSZ, which ends a program by default, must not
for arguments in ["render tiny.toml --pattern white --progress none --samples 1 -o out.npy",
                  "render tiny.toml --panel-image panel.png --progress none --bits 16 -o out.png",
                  "photo tiny.toml --model pyramid.obj --size 600x400 --progress none -o out.exr",
                  "eia tiny.toml --pattern address -o out.npy", "sheet panel.png panel.png --width-px 1000 -o out.npy"]:
    checks.refused(program, arguments, arguments, "cannot be written", code=1, **options)

# What was there before stays.
(program.folder / "old.npy").write_bytes(b"precious")
checks.refused(program, "old file", "eia tiny.toml --pattern address -o old.npy", "old.npy", code=1, **options)
checks.that((program.folder / "old.npy").read_bytes() == b"precious", "the old file is damaged")
checks.finish()

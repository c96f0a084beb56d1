#!/usr/bin/python3
"""What same_code.py takes for the same, and what not. Usage: same_code_test.py COMPILER"""
import pathlib
import subprocess
import sys
import tempfile

SAME_CODE = pathlib.Path(__file__).with_name("same_code.py")
SUM = """
struct Lens {
    virtual ~Lens();
    virtual double bend(double x) const { return 0.3 * x + more(x); }
    virtual double reach(double x) const { return x / 7.5; }
    double more(double) const;
};
"""
PARTS = ["""
static double half(double x) { return x > 0 ? x * 0.5 : -x; }
""", """
__attribute__((noinline)) double third(double x) { return x / 3; }
__attribute__((noinline)) double fifth(double x) { return x / 5; }
""", """
Lens::~Lens() {}
double Lens::more(double x) const { return x * x; }
""", """
double sum(const Lens* lenses, int count) {
    double total = 0;
    for (int i = 0; i < count; ++i) total += half(lenses[i].bend(i + 12)) + third(i);
    return total;
}
""", """
const char* name(int kind) {
    switch (kind) {
        case 0: return "square";
        case 1: return "hexagon";
        case 2: return "brick";
        case 3: return "strips";
    }
    return "none";
}
""", """
void other(int);
int chosen(int kind, int x) {
    switch (kind) {
        case 0: other(x); return x + 1;
        case 1: return x * 3;
        case 2: other(x + 2); return x - 5;
        case 3: return x ^ 9;
        case 4: other(1); return x / 3;
        case 5: return x % 11;
    }
    return x;
}
"""]
SOURCE = SUM + "".join(PARTS)
REORDERED = SUM + "".join([PARTS[1], PARTS[0], *PARTS[:1:-1]])
SAME = {
    "nothing": SOURCE,
    "a type of another name": SOURCE.replace("Lens", "ConvexLenslet"),
    "functions of other names": SOURCE.replace("half", "by_two").replace("sum", "of_all_lenses").replace("third", "over"),
    "another order": REORDERED,
}
OTHER = {
    "an instruction": SOURCE.replace("i + 12", "i - 12"),
    "a number within an instruction": SOURCE.replace("i + 12", "i + 13"),
    "a constant in memory": SOURCE.replace("0.5", "0.25"),
    "a constant of an inline function": SOURCE.replace("0.3 *", "0.4 *"),
    "a string": SOURCE.replace("brick", "stone"),
    "two strings": SOURCE.replace("brick", "x").replace("strips", "brick").replace("x", "strips"),
    "two cases": SOURCE.replace("case 1: return x *", "case X: return x *").replace("case 3: return x ^", "case 1: return x ^")
                       .replace("case X", "case 3"),
    "which function is called": SOURCE.replace("third(i)", "fifth(i)"),
    "a call of what lies outside": SOURCE.replace("other(", "another("),
    "two virtual functions": SOURCE.replace("double bend(", "double X(").replace("double reach(", "double bend(").replace("X(", "reach("),
}


def built(folder, source, name):
    folder.mkdir()
    command = [sys.argv[1], "-std=c++20", "-O2", "-fPIC", "-x", "c++", "-", "-c", "-o", folder / f"{name}.o"]
    subprocess.run(command, input=source, text=True, check=True)
    return folder


wrong = 0
with tempfile.TemporaryDirectory(prefix="same-code-") as temporary:
    folder = pathlib.Path(temporary)
    before = built(folder / "before", SOURCE, "lens")
    for number, (what, source) in enumerate((SAME | OTHER).items()):
        assert what == "nothing" or source != SOURCE, what
        done = subprocess.run([sys.executable, SAME_CODE, before, built(folder / str(number), source, "moved")], capture_output=True, text=True)
        if (what in SAME) != (done.returncode == 0) or done.stderr:
            wrong += 1
            print(f"WRONG: {what}:\n{done.stdout}{done.stderr}")
print(f"{len(SAME) + len(OTHER)} changes, {wrong} judged wrongly")
sys.exit(1 if wrong else 0)

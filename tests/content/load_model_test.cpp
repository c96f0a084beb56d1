// Bad models, and readers that go wrong: every one is an InputError that says which file and why.
#include "small_world.h"

#include <chrono>

namespace {

using namespace small_world;

constexpr const char* samples = "/usr/share/assimp/models";

std::string refusal(const fs::path& file, const LoadOptions& options = {}) {
    try {
        load_model(file, options);
    } catch (const InputError& e) {
        EXPECT_EQ(e.problems.size(), 1u);
        EXPECT_EQ(e.problems[0].where, file.string());
        return e.problems[0].what;
    }
    ADD_FAILURE() << file << " was read";
    return {};
}

TEST(LoadModel, CountsWhatItRead) {
    Folder folder;
    const ModelInfo i = info(*load_model(write_patches(folder, {{-1, 1, -1, 1, 0, "red"}, {-1, 1, -1, 1, 2, "green"}})));
    EXPECT_EQ(i.triangles, 4);
    EXPECT_EQ(i.vertices, 8);
    EXPECT_EQ(i.materials, 2);
    EXPECT_EQ(i.textures, 0);
    EXPECT_THAT(i.notes, testing::IsEmpty());
}

// Its own folder, where the material file lies, is the one the link leads to.
TEST(LoadModel, ModelBehindALink) {
    Folder folder, other;
    fs::create_symlink(write_patches(folder, {{-1, 1, -1, 1, 0, "red"}}), other.path() / "link.obj");
    EXPECT_THAT(info(*load_model(other.path() / "link.obj")).notes, testing::IsEmpty());
}

TEST(LoadModel, FilesThatAreNoModels) {
    Folder folder;
    EXPECT_THAT(refusal(folder.path() / "missing.obj"), testing::HasSubstr("no such"));
    EXPECT_THAT(refusal(folder.path()), testing::HasSubstr("not a file"));
    EXPECT_THAT(refusal("/dev/zero"), testing::HasSubstr("not a file"));
    EXPECT_THAT(refusal(folder.write("empty.obj", "")), testing::HasSubstr("empty"));
    EXPECT_THAT(refusal(folder.write("text.txt", "hello")), testing::HasSubstr("is damaged, or of no format that is read"));
    EXPECT_THAT(refusal(folder.write("noise.stl", std::string(1000, '\xff'))), testing::Not(testing::IsEmpty()));
    EXPECT_THAT(refusal(folder.write("points.obj", "v 0 0 0\nv 1 1 1\n")), testing::Not(testing::IsEmpty()));
    EXPECT_THAT(refusal(folder.write("line.obj", "v 0 0 0\nv 1 1 1\nl 1 2\n")), testing::Not(testing::IsEmpty()));
    EXPECT_THAT(refusal(folder.write("nan.obj", "v nan 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3\n")), testing::HasSubstr("not a number"));
    EXPECT_THAT(refusal(folder.write("index.obj", "v 0 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 300\n")), testing::HasSubstr("index"));
}

TEST(LoadModel, OptionsAreChecked) {
    Folder folder;
    const fs::path model = write_patches(folder, {{-1, 1, -1, 1, 0, "red"}});
    for (const double seconds : {0., -1., 1e9, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(load_model(model, {seconds, 1 << 30, ""}), InputError);
    EXPECT_THROW(load_model(model, {10, 0, ""}), InputError);
}

TEST(LoadModel, BrokenSamples) {
    if (!fs::exists(samples)) GTEST_SKIP() << "needs Debian's assimp-testmodels";
    const std::pair<const char*, const char*> table[] = {
        {"glTF2/MissingBin/BoxTextured.gltf", "BoxTextured0.bin"},
        {"glTF2/RecursiveNodes/RecursiveNodes.gltf", "descendant of itself"},
        {"glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf", "do not exist"},
        {"glTF2/IndexOutOfRange/IndexOutOfRange.gltf", "do not exist"},
        {"glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "infinite"},
        {"glTF2/SchemaFailures/sceneWrongType.gltf", "scene"},
        {"invalid/empty.3ds", "empty"},
        {"RAW/WithColor.raw", "crash"},
    };
    for (const auto& [name, what] : table) EXPECT_THAT(refusal(fs::path(samples) / name), testing::HasSubstr(what)) << name;
    if (memory_is_limited) {
        EXPECT_THAT(refusal(fs::path(samples) / "invalid/OutOfMemory.off"), testing::HasSubstr("MiB"));
    }
}

// None of the samples, good or bad, brings down this process.
TEST(LoadModel, AllSamples) {
    if (!fs::exists(samples)) GTEST_SKIP() << "needs Debian's assimp-testmodels";
    int read = 0, refused = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(samples)) {
        if (!entry.is_regular_file()) continue;
        if (!memory_is_limited && entry.path().filename() == "OutOfMemory.off") continue;
        try {
            EXPECT_GT(info(*load_model(entry.path())).triangles, 0);
            ++read;
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), testing::HasSubstr(entry.path().filename().string()));
            ++refused;
        }
    }
    RecordProperty("read", read);
    RecordProperty("refused", refused);
    EXPECT_GT(read, 300);
    EXPECT_GT(refused, 100);
}

TEST(LoadModel, MemoryIsLimited) {
    if (!memory_is_limited) GTEST_SKIP() << "AddressSanitizer excludes limits of the address space";
    Folder folder;
    std::ostringstream obj;
    for (int k = 0; k < 300000; ++k) obj << "v " << k % 317 << " " << k % 113 << " 0\n";
    for (int k = 1; k < 299998; ++k) obj << "f " << k << " " << k + 1 << " " << k + 2 << "\n";
    const fs::path model = folder.write("big.obj", obj.str());
    EXPECT_THAT(refusal(model, {60, 160 << 20, ""}),
                testing::HasSubstr("more than 160 MiB, the most that reading a file may take"));
    EXPECT_THAT(refusal(model, {60, 160 << 20, "", nullptr, "what this test allows"}),
                testing::HasSubstr("160 MiB, what this test allows"));
    EXPECT_GT(info(*load_model(model)).triangles, 100000);
}

// Readers that misbehave, in the place of the true one.
class Impostor : public testing::Test {
  protected:
    ~Impostor() override { unsetenv("LFDSIM_MODEL_READER"); }
    std::string answer(const std::string& script, double seconds = 20) {
        const fs::path program = folder_.write("reader", "#!/bin/sh\n" + script + "\n"),
                       model = folder_.write("m.obj", "v 0 0 0\n");
        fs::permissions(program, fs::perms::owner_all);
        setenv("LFDSIM_MODEL_READER", program.c_str(), 1);
        return refusal(model, {seconds, 1 << 20, ""});
    }
    Folder folder_;
};

TEST_F(Impostor, TooSlow) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(answer("exec sleep 30", 0.3), testing::HasSubstr("more than 0.3 s"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST_F(Impostor, Crashes) { EXPECT_THAT(answer("kill -SEGV $$"), testing::HasSubstr("Segmentation fault")); }
TEST_F(Impostor, Fails) { EXPECT_THAT(answer("exit 3"), testing::HasSubstr("status 3")); }
TEST_F(Impostor, IsKilled) { EXPECT_THAT(answer("kill -KILL $$"), testing::HasSubstr("killed")); }
TEST_F(Impostor, EndsEarly) { EXPECT_THAT(answer("exit 0"), testing::HasSubstr("ended early")); }
TEST_F(Impostor, TalksNonsense) { EXPECT_THAT(answer("echo no model at all"), testing::HasSubstr("is invalid")); }

// A model's head (reply, little-endian), then counts that cannot be or bytes without end.
TEST_F(Impostor, ClaimsTooMuch) {
    EXPECT_THAT(answer("printf '1omL\\377\\377\\377\\377\\377\\377\\377\\377'; exec cat /dev/zero"),
                testing::HasSubstr("more than 1 MiB"));
}

// Positions for one vertex and nothing else: all lists empty.
TEST_F(Impostor, ListsThatDoNotFit) {
    EXPECT_THAT(answer("printf '1omL'; exec head -c 80 /dev/zero"), testing::HasSubstr("no triangles"));
}

TEST_F(Impostor, MissingReaderIsNoFaultOfTheModel) {
    setenv("LFDSIM_MODEL_READER", "/nowhere/reader", 1);
    EXPECT_THROW(
        {
            try {
                load_model(folder_.write("m.obj", "v 0 0 0\n"));
            } catch (const InputError&) {
                FAIL() << "blames the model";
            }
        },
        std::runtime_error);
}

}  // namespace

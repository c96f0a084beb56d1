#include "view/server/messages.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <nlohmann/json.hpp>

#include "base/input_error.h"

namespace lfdsim::view {
namespace {
using Json = nlohmann::json;
using testing::HasSubstr;

const char* const kinds[] = {"start", "model", "panel_image", "pattern"};
const char* const layouts[] = {"one", "pair", "crossed"};
const char* const besides[] = {"none", "photograph", "difference"};

Json json_of(const Wanted& w) {
    return {{"type", "show"},
            {"id", w.id},
            {"display", w.display},
            {"set", w.set},
            {"shown", {{"kind", kinds[int(w.shown.kind)]}, {"name", w.shown.name}, {"hold", w.shown.hold}}},
            {"eye_mm", w.eye_mm},
            {"size", w.size},
            {"layout", layouts[int(w.layout)]},
            {"eye_distance_mm", w.eye_distance_mm},
            {"beside", besides[int(w.beside)]},
            {"moving", w.moving}};
}

std::string problem(const std::string& text) {
    try {
        parse_message(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

/// The example's message with one part replaced.
std::string with(const char* pointer, Json value) {
    Json json = json_of(Wanted{});
    json[Json::json_pointer(pointer)] = std::move(value);
    return json.dump();
}

// Words of two letters, one of them two bytes long.
rc::Gen<std::string> text() {
    return rc::gen::map(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 3)), [](const std::vector<int>& letters) {
        std::string all = "x";
        for (const int letter : letters) all += letter == 0 ? "a" : letter == 1 ? "\xc3\xa9" : "\"";
        return all.substr(0, all.size() > 500 ? 1 : all.size());
    });
}
rc::Gen<double> real(int most) {
    return rc::gen::map(rc::gen::inRange(-1000000, 1000001), [most](int n) { return most * (n / 1000000.0); });
}

RC_GTEST_PROP(ViewMessages, SurviveTheirJsonText, ()) {
    Wanted w;
    w.id = *rc::gen::inRange<std::int64_t>(0, std::int64_t(1) << 53);
    w.display = *text();
    w.set = *rc::gen::container<std::vector<std::string>>(text());
    RC_PRE(w.set.size() <= 100u);
    w.shown = {Shown::Kind(*rc::gen::inRange(0, 4)), *text(), *rc::gen::arbitrary<bool>()};
    w.eye_mm = {*real(1000000), *real(1000), *real(1)};
    w.size = {*rc::gen::inRange(16, 4097), *rc::gen::inRange(16, 2026)};
    w.layout = Layout(*rc::gen::inRange(0, 3));
    w.eye_distance_mm = std::abs(*real(1000));
    w.beside = Beside(*rc::gen::inRange(0, 3));
    w.moving = *rc::gen::arbitrary<bool>();
    const std::string message = json_of(w).dump();
    RC_ASSERT(std::get<Wanted>(parse_message(message)) == w);
    // cut short anywhere it is no message, and no other letter at any place may bring the program down
    const auto at = *rc::gen::inRange<std::size_t>(0, message.size());
    RC_ASSERT(problem(message.substr(0, at)) != "none");
    std::string changed = message;
    changed[at] = *rc::gen::arbitrary<char>();
    problem(changed);
}

TEST(ViewMessages, QuestionsAreParsed) {
    const Ask probe = std::get<Ask>(parse_message(R"({"type": "ask", "id": 3, "what": "probe", "at": [0.25, 1]})"));
    EXPECT_EQ(probe.id, 3);
    EXPECT_EQ(probe.what, Ask::What::probe);
    EXPECT_EQ(probe.at, (std::array<double, 2>{0.25, 1}));
    const Ask save = std::get<Ask>(parse_message(R"({"type":"ask","id":8,"what":"save","name":"a b.toml","overwrite":true})"));
    EXPECT_EQ(save.what, Ask::What::save);
    EXPECT_EQ(save.name, "a b.toml");
    EXPECT_TRUE(save.overwrite);
    EXPECT_EQ(std::get<Ask>(parse_message(R"({"type":"ask","id":1,"what":"plot","name":"spot"})")).name, "spot");
    EXPECT_EQ(std::get<Ask>(parse_message(R"({"type":"ask","id":1,"what":"exr"})")).what, Ask::What::exr);
}

TEST(ViewMessages, AnythingElseIsRefused) {
    for (const char* text : {"",
                             " ",
                             "null",
                             "7",
                             "[]",
                             "{}",
                             "{\"type\":\"show\"}",
                             "{\"type\":\"hide\"}",
                             "{\"type\":7}",
                             "{\"type\":\"ask\",\"id\":1}",
                             R"({"type":"ask","id":1,"what":"files","name":"x"})",
                             R"({"type":"ask","id":1,"what":"files","id":2})",
                             R"({"type":"ask","id":-1,"what":"files"})",
                             R"({"type":"ask","id":1.5,"what":"files"})",
                             R"({"type":"ask","id":18446744073709551615,"what":"files"})",
                             R"({"type":"ask","id":9223372036854775808,"what":"files"})",
                             R"({"type":"ask","id":1e400,"what":"files"})",
                             R"({"type":"ask","id":"1","what":"files"})",
                             R"({"type":"ask","id":1,"what":"side","name":"fov"})",
                             R"({"type":"ask","id":1,"what":"plot"})",
                             R"({"type":"ask","id":1,"what":"probe","at":[0.5]})",
                             R"({"type":"ask","id":1,"what":"probe","at":[0.5,1.1]})",
                             R"({"type":"ask","id":1,"what":"probe","at":[0.5,NaN]})",
                             R"({"type":"ask","id":1,"what":"probe","at":[0.5,null]})",
                             R"({"type":"ask","id":1,"what":"files"} x)",
                             R"({"type":"ask","id":1,"what":"files",})",
                             "{\"type\":\"ask\",\"id\":1,\"what\":\"files\xff\"}",
                             "{\"type\":\"ask\",\"id\":1,\"what\":\"save\",\"name\":\"\xc3\"}",
                             R"({"type":"ask","id":1,"what":"save","name":"a\u0000b"})",
                             R"({"type":"ask","id":1,"what":"save","name":"\ud800"})"})
        EXPECT_NE(problem(text), "none") << text;
    EXPECT_EQ(problem(with("/moving", true)), "none");
    EXPECT_THAT(problem(with("/size", {16, 15})), HasSubstr("size"));
    EXPECT_THAT(problem(with("/size", {4096, 4096})), HasSubstr("8294400 pixels or fewer"));
    EXPECT_THAT(problem(with("/size", {640.5, 480})), HasSubstr("size"));
    EXPECT_THAT(problem(with("/eye_mm/2", 1.1e6)), HasSubstr("eye_mm"));
    EXPECT_THAT(problem(with("/eye_distance_mm", -1)), HasSubstr("eye_distance_mm"));
    EXPECT_THAT(problem(with("/moving", 1)), HasSubstr("true or false"));
    EXPECT_THAT(problem(with("/more", 1)), HasSubstr("more: is unknown in the message"));
    EXPECT_THAT(problem(with("/shown/more", 1)), HasSubstr("more: is unknown in shown"));
    EXPECT_THAT(problem(with("/shown/kind", "model")), HasSubstr("name: is missing"));
    EXPECT_THAT(problem(with("/set", std::vector<std::string>(101, "a=1"))), HasSubstr("at most 100"));
    EXPECT_THAT(problem(with("/set", {std::string(1001, 'x')})), HasSubstr("at most 1000 bytes"));
    EXPECT_THAT(problem(with("/set", {"a=1\nb=2"})), HasSubstr("control characters"));
    EXPECT_THAT(problem(with("/set", {{"a"}})), HasSubstr("set"));
    EXPECT_THAT(problem(with("/set", {{{"a"}}})), HasSubstr("deep"));
    EXPECT_THAT(problem(std::string(60000, '[')), HasSubstr("deep"));
    EXPECT_THAT(problem(with("/display", std::string(70000, 'x'))), HasSubstr("allowed are 65536"));
    const Json whole = json_of(Wanted{});
    for (const auto& [key, value] : whole.items()) {
        Json less = whole;
        less.erase(key);
        EXPECT_THAT(problem(less.dump()), HasSubstr(key + ": is missing"));
    }
}

}  // namespace
}  // namespace lfdsim::view

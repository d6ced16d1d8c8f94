// Configuration files: attributes, values, links to and from the program.

#include "frontend/query/config_queries.h"

#include "frontend/query/navigation.h"
#include "query_testing.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

using Lines = std::vector<std::string>;

sema::CheckOptions withSignals() {
    sema::CheckOptions options;
    options.signals = {{"do_grip", "signaldo"}, {"di_ready", "signaldi"}};
    options.configurationKnown = true;
    return options;
}

/// A configuration text with a marker `$1`, and a program that uses its signals.
struct Config {
    explicit Config(std::string text)
        : program({inMain("SetDO do_grip,1;\nWaitDI di_ready,1;")}, {std::move(text)}, withSignals()) {
        file = program.snapshot().configuration()[0];
    }
    Lines labels(uint32_t at) const {
        Lines out;
        for (const CompletionItem& item : configCompletionAt(program.snapshot(), *file, at).items)
            out.push_back(item.label);
        return out;
    }
    Program program;
    std::shared_ptr<const SourceFile> file;
};

bool has(const Lines& lines, std::string_view line) {
    return std::find(lines.begin(), lines.end(), line) != lines.end();
}

const std::string kSignals = "EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name \"do_grip\" -SignalType "
                             "\"DO\" \\\n      -Label \"Gripper\"\n\n"
                             "      -Name \"di_ready\" -SignalType \"DI\"\n#\nEIO_CROSS:\n\n      -Name "
                             "\"both\" -Res \"do_grip\" -Act1 \"di_ready\"";

} // namespace

TEST_CASE("query: configuration text with places", "[query][config]") {
    const ConfigText text = readConfigText(kSignals);
    CHECK(text.domain == "EIO");
    REQUIRE(text.sections.size() == 2);
    REQUIRE(text.sections[0].instances.size() == 2);
    const ConfigInstance& grip = text.sections[0].instances[0];
    CHECK(grip.text("label") == "Gripper");
    const ConfigAttribute* name = grip.find("Name");
    REQUIRE(name);
    CHECK(kSignals.substr(name->valueRange.begin, name->valueRange.end - name->valueRange.begin) ==
          "do_grip");
    CHECK(readConfigText("").sections.empty());
    CHECK(readConfigText("x\n-Name \"a\"\n\"\\").sections.empty());
}

TEST_CASE("query: attributes that an instance does not have yet", "[query][config]") {
    const std::string before = "EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name \"a\" -SignalType \"DO\" -";
    const Config config(before + "\n");
    const Lines labels = config.labels(static_cast<uint32_t>(before.size()));
    CHECK(has(labels, "Device"));
    CHECK(has(labels, "Access"));
    CHECK_FALSE(has(labels, "Name"));
    CHECK_FALSE(has(labels, "SignalType"));
    CHECK_FALSE(has(labels, "MotionTask")); // of a different type
}

TEST_CASE("query: values of attributes", "[query][config]") {
    const auto at = [](const std::string& text) {
        return Config(text).labels(static_cast<uint32_t>(text.size()));
    };
    CHECK(at("EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name \"a\" -SignalType \"") ==
          Lines{"DI", "DO", "AI", "AO", "GI", "GO"});
    CHECK(at("EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name \"a\" -SignalType \"A") == Lines{"AI", "AO"});
    CHECK(at(kSignals + " -Oper1 \"") == Lines{"AND", "OR"});
    CHECK(at(kSignals + " -Act2 \"") == Lines{"do_grip", "di_ready"});
    CHECK(at("SYS:CFG_1.0:7:0::\n#\nCAB_TASKS:\n\n      -Name \"T_A\" -Entry \"") == Lines{"main"});
    const Lines types = at("EIO:CFG_1.0:7:0::\n#\n");
    CHECK(has(types, "EIO_SIGNAL"));
    CHECK_FALSE(has(types, "CAB_TASKS"));
}

TEST_CASE("query: from a signal in the program to its definition and back", "[query][config]") {
    const Config config(kSignals);
    const FileView& module = *config.program.snapshot().file("t1_1.modx");
    const auto use = static_cast<uint32_t>(module.text().find("do_grip"));
    const auto places = definitionAt(config.program.snapshot(), module, use);
    REQUIRE(places.size() == 1);
    CHECK(places[0].file->path() == "EIO0.cfg");
    CHECK(places[0].range.begin == kSignals.find("do_grip"));
    const auto cross = static_cast<uint32_t>(kSignals.rfind("do_grip") + 2);
    const auto defined = configDefinitionAt(config.program.snapshot(), config.file, cross);
    REQUIRE(defined.size() == 1);
    CHECK(defined[0].range.begin == kSignals.find("do_grip"));
    const auto uses = configUsesAt(config.program.snapshot(), config.file, cross);
    REQUIRE(uses.size() == 3); // definition, cross connection, program
    CHECK(uses[2].place.file->path() == "t1_1.modx");
    CHECK(uses[2].place.range.begin == use);
}

TEST_CASE("query: hover and outline of a configuration", "[query][config]") {
    const Config config(kSignals);
    const auto hover = [&](std::string_view word) {
        return configHoverAt(config.program.snapshot(), *config.file,
                             static_cast<uint32_t>(kSignals.find(word) + 1));
    };
    REQUIRE(hover("SignalType"));
    CHECK(hover("SignalType")->facts == "One of: DI|DO|AI|AO|GI|GO");
    REQUIRE(hover("do_grip"));
    CHECK(hover("do_grip")->declaration == "signaldo do_grip");
    CHECK(hover("do_grip")->documentation == "Gripper");
    REQUIRE(hover("EIO_CROSS"));
    CHECK(hover("EIO_CROSS")->documentation.find("- `Res`: Signal that is set") != std::string::npos);
    CHECK_FALSE(hover("Gripper"));
    const auto outline = configOutline(kSignals);
    REQUIRE(outline.size() == 2);
    REQUIRE(outline[0].children.size() == 2);
    CHECK(outline[0].children[1].name == "di_ready");
    CHECK(outline[0].children[1].detail == "DI");
}

TEST_CASE("query: every configuration query at every offset", "[query][config][every]") {
    const Config config(kSignals + "\n- -x \"a\n-Name -");
    const auto size = static_cast<uint32_t>(config.file->text().size());
    for (uint32_t at = 0; at <= size + 1; ++at) {
        const CompletionList list = configCompletionAt(config.program.snapshot(), *config.file, at);
        REQUIRE(list.replace.end <= size);
        if (const auto hover = configHoverAt(config.program.snapshot(), *config.file, at))
            REQUIRE(hover->range.end <= size);
        for (const Location& place : configDefinitionAt(config.program.snapshot(), config.file, at))
            REQUIRE(place.range.end <= place.file->text().size());
        REQUIRE(configUsesAt(config.program.snapshot(), config.file, at).size() < 10);
    }
}

// Images of compiled modules: mapped anywhere, bound to what the process has.

#include <cstring>
#include <map>
#include <set>

#include "ir/passes/passes.h"
#include "runtime/host/mapped_image.h"
#include "tests/unit/codegen/fake_runtime.h"
#include "tests/unit/ir/ir_testing.h"

using namespace codegen_testing;
using ir_testing::corpusModule;

namespace {

rt::UnitImage imageOf(const std::string& name) {
    ir::Module module = corpusModule(name);
    REQUIRE(ir::runPasses(module, {}).empty());
    rt::UnitImage image;
    std::string error;
    const bool made = codegen::emitImage(module, {}, image, error);
    INFO(error);
    REQUIRE(made);
    return image;
}

std::vector<const void*> addressesFor(const rt::UnitImage& image, const void* external) {
    std::map<std::string, const void*> known{{"ext", external}};
    for (const codegen::NativeSymbol& symbol : symbols())
        known.emplace(symbol.name, symbol.address);
    static const std::map<std::string, const void*> kOfTheLibrary{
        {"memcpy", reinterpret_cast<const void*>(&std::memcpy)},
        {"memset", reinterpret_cast<const void*>(&std::memset)}};
    known.insert(kOfTheLibrary.begin(), kOfTheLibrary.end());
    std::vector<const void*> addresses;
    for (const std::string& import : image.imports) {
        INFO(import);
        REQUIRE(known.contains(import));
        addresses.push_back(known[import]);
    }
    return addresses;
}

} // namespace

TEST_CASE("a mapped image describes its program", "[codegen]") {
    static int32_t external = 5;
    const rt::UnitImage image = imageOf("everything.rir");
    std::string error;
    const auto first = rt::MappedImage::map(image, addressesFor(image, &external), error);
    const auto second = rt::MappedImage::map(image, addressesFor(image, &external), error);
    REQUIRE(first);
    REQUIRE(second);
    for (const auto* mapped : {first.get(), second.get()}) {
        const rt::ProgramDesc& desc = *mapped->program();
        CHECK(std::string(desc.name) == "every \"thing\"");
        REQUIRE(desc.taskCount == 2);
        CHECK(std::string(desc.tasks[1].type) == "SEMISTATIC");
        REQUIRE(desc.routineCount == 1);
        CHECK(std::string(desc.routines[0].desc->name) == "main");
    }
    CHECK(first->program() != second->program());
    CHECK(first->program()->externals[0].slot != second->program()->externals[0].slot);
}

TEST_CASE("an image says what it needs from the process", "[codegen]") {
    const rt::UnitImage image = imageOf("handlers.rir");
    const std::set<std::string> imports(image.imports.begin(), image.imports.end());
    CHECK(imports.size() == image.imports.size());
    CHECK(imports.contains("rt_fallible"));
    CHECK(imports.contains("rt_nativeFailed"));
    CHECK_FALSE(image.patches.empty());
    for (const rt::UnitImage::Segment& segment : image.segments)
        CHECK_FALSE((segment.writable && segment.executable));
}

TEST_CASE("an image that makes no sense is refused", "[codegen]") {
    const rt::UnitImage image = imageOf("everything.rir");
    static int32_t external = 5;
    const auto addresses = addressesFor(image, &external);
    const auto refused = [&](auto change) {
        rt::UnitImage other = image;
        change(other);
        std::string error;
        return rt::MappedImage::map(other, addresses, error) == nullptr && !error.empty();
    };
    CHECK(refused([](rt::UnitImage& other) { other.size = 0; }));
    CHECK(refused([](rt::UnitImage& other) { other.size = uint64_t{1} << 60; }));
    CHECK(refused([](rt::UnitImage& other) { other.program = other.size - 8; }));
    CHECK(refused([](rt::UnitImage& other) { other.segments[0].offset += 1; }));
    CHECK(refused([](rt::UnitImage& other) { other.segments[0].offset = other.size; }));
    CHECK(refused([](rt::UnitImage& other) { other.segments[0].size = ~uint64_t{0}; }));
    CHECK(refused([](rt::UnitImage& other) { other.patches[0].offset = other.size - 7; }));
    CHECK(refused([](rt::UnitImage& other) { other.patches[0].import = 1000; }));
    CHECK(refused([](rt::UnitImage& other) { other.patches[0].import = -2; }));
    CHECK(refused([](rt::UnitImage& other) { other.imports.emplace_back("more"); }));
}

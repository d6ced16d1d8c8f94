// libFuzzer target: any configuration file, changed as clients change it. What is written reads back as the same, and a value
// that the format cannot hold is recognised.

#include "config/cfg_parser.h"
#include "config/cfg_writer.h"
#include "config/text_util.h"
#include "fuzz_support.h"

#include <algorithm>

namespace {

using namespace rapid;
using fuzz::require;

/// The first bytes are a value and a name; the rest is a file.
std::string takeLine(std::string& bytes) {
    const size_t end = std::min(bytes.find('\n'), bytes.size());
    std::string line = bytes.substr(0, end);
    bytes.erase(0, std::min(end + 1, bytes.size()));
    return line;
}

bool isWritable(const config::CfgFile& file) {
    if (!config::isCfgName(file.domain)) return false;
    for (const config::CfgSection& section : file.sections) {
        // '#' and digits may begin the name of a type that is read; clients cannot write it
        if (!config::isCfgName(section.type) ||
            (!section.baseType.empty() && !config::isCfgName(section.baseType)))
            return false;
        for (const config::CfgInstance& instance : section.instances)
            for (const config::CfgAttribute& attribute : instance.attributes)
                if (!config::isCfgName(attribute.name) ||
                    !std::all_of(attribute.values.begin(), attribute.values.end(), config::isCfgValue))
                    return false;
    }
    return true;
}

void compare(const config::CfgFile& a, const config::CfgFile& b) {
    require(a.domain == b.domain && a.sections.size() == b.sections.size(), "a different number of sections");
    for (size_t s = 0; s < a.sections.size(); ++s) {
        std::vector<const config::CfgInstance*> kept;
        for (const config::CfgInstance& instance : a.sections[s].instances)
            if (!instance.attributes.empty()) kept.push_back(&instance);
        require(a.sections[s].type == b.sections[s].type && kept.size() == b.sections[s].instances.size(),
                "another section");
        for (size_t i = 0; i < kept.size(); ++i) {
            const auto &first = kept[i]->attributes, &second = b.sections[s].instances[i].attributes;
            require(first.size() == second.size(), "a different number of attributes");
            for (size_t n = 0; n < first.size(); ++n)
                require(first[n].name == second[n].name && first[n].values == second[n].values,
                        "another attribute");
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string bytes = fuzz::bytesOf(data, size);
    const std::string value = config::toUtf8(takeLine(bytes)), name = takeLine(bytes);
    std::vector<config::CfgProblem> problems;
    config::CfgFile file = config::parseCfg(bytes, "fuzz.cfg", problems);
    if (config::isCfgName(name) && config::isCfgValue(value) && !file.sections.empty())
        for (config::CfgInstance& instance : file.sections.front().instances)
            instance.attributes.push_back({name, {value}, size % 2 == 0, 0});
    if (!isWritable(file)) return 0;
    const std::string text = config::writeCfg(file);
    for (const std::string& form : {text, config::toLatin1(text)}) {
        problems.clear();
        compare(file, config::parseCfg(form, "written.cfg", problems));
        require(problems.empty(), "the written text has mistakes");
    }
    return 0;
}

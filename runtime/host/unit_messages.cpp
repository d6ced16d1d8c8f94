#include "runtime/host/unit_messages.h"

#include "runtime/host/cbor.h"

namespace rt {
namespace {

using Json = nlohmann::json;

Json jsonOf(const UnitImage& image) {
    Json json{{"size", image.size}, {"program", image.program}, {"imports", image.imports}};
    json["segments"] = Json::array();
    for (const UnitImage::Segment& segment : image.segments)
        json["segments"].push_back(
            {segment.offset, segment.size, binaryJson(segment.bytes), segment.writable, segment.executable});
    json["patches"] = Json::array();
    for (const UnitImage::Patch& patch : image.patches)
        json["patches"].push_back({patch.offset, patch.addend, patch.import});
    return json;
}

UnitImage imageOf(const Json& json) {
    UnitImage image;
    image.size = json.at("size").get<uint64_t>();
    image.program = json.at("program").get<uint64_t>();
    image.imports = json.at("imports").get<std::vector<std::string>>();
    for (const Json& row : json.at("segments"))
        image.segments.push_back({row.at(0).get<uint64_t>(), row.at(1).get<uint64_t>(), bytesOf(row.at(2)),
                                  row.at(3).get<bool>(), row.at(4).get<bool>()});
    for (const Json& row : json.at("patches"))
        image.patches.push_back(
            {row.at(0).get<uint64_t>(), row.at(1).get<int64_t>(), row.at(2).get<int32_t>()});
    return image;
}

Json jsonOf(const ProgramTables& tables) {
    Json json{{"modules", Json::array()}, {"data", Json::array()}};
    for (const LoadedModule& module : tables.modules())
        json["modules"].push_back({module.name, module.task, module.file, module.unit != nullptr});
    for (const GlobalDesc* data : tables.globals())
        json["data"].push_back({data->name, data->module, data->task, data->kind, data->flags});
    return json;
}

} // namespace

std::string writeUnitRequest(std::string_view sources, bool references, const LoadRequest& load,
                             const ProgramState& state, const SignalNames& signals) {
    Json json{{"sources", binaryJson(sources)},  {"references", references}, {"task", load.task},
              {"index", load.taskIndex},         {"path", load.path},        {"shown", load.shown},
              {"bytes", binaryJson(load.bytes)}, {"signals", signals},       {"memory", jsonOf(state.tables)},
              {"files", Json::array()}};
    for (const LoadedFile& file : state.files)
        json["files"].push_back({file.task, file.path, file.shown, binaryJson(file.bytes)});
    return writeCbor(json);
}

std::unique_ptr<UnitRequest> readUnitRequest(std::string_view bytes) try {
    const Json json = readCbor(bytes);
    auto request = std::make_unique<UnitRequest>();
    request->sources = bytesOf(json.at("sources"));
    request->references = json.at("references").get<bool>();
    request->load = {json.at("task").get<std::string>(), json.at("index").get<int32_t>(),
                     json.at("path").get<std::string>(), json.at("shown").get<std::string>(),
                     bytesOf(json.at("bytes"))};
    request->signals = json.at("signals").get<SignalNames>();
    for (const Json& row : json.at("files"))
        request->files.push_back({row.at(0).get<int32_t>(), row.at(1).get<std::string>(),
                                  row.at(2).get<std::string>(), bytesOf(row.at(3))});
    const auto keep = [&](const Json& text) {
        return request->names_.emplace_back(text.get<std::string>()).c_str();
    };
    for (const Json& row : json.at("memory").at("data")) {
        GlobalDesc data{};
        data.name = keep(row.at(0));
        data.module = keep(row.at(1));
        data.task = row.at(2).get<int32_t>();
        data.kind = row.at(3).get<uint8_t>();
        data.flags = row.at(4).get<uint8_t>();
        request->data_.push_back(data);
    }
    std::vector<LoadedModule> loaded;
    for (const Json& row : json.at("memory").at("modules")) {
        if (!row.at(3).get<bool>()) {
            request->modules_.push_back(
                {keep(row.at(0)), keep(row.at(2)), row.at(1).get<int32_t>(), nullptr});
            continue;
        }
        LoadedModule& module = loaded.emplace_back();
        module.name = row.at(0).get<std::string>();
        module.task = row.at(1).get<int32_t>();
        module.file = row.at(2).get<std::string>();
    }
    request->program_.globals = request->data_.data();
    request->program_.globalCount = static_cast<uint32_t>(request->data_.size());
    request->program_.modules = request->modules_.data();
    request->program_.moduleCount = static_cast<uint32_t>(request->modules_.size());
    request->tables.setProgram(request->program_);
    for (LoadedModule& module : loaded)
        request->tables.addUnit(request->unit_, std::move(module));
    return request;
} catch (const Json::exception&) {
    return nullptr;
}

std::string writeUnitAnswer(const UnitAnswer& answer) {
    Json json{{"verdict", static_cast<int>(answer.unit.verdict)},
              {"module", answer.unit.module},
              {"problems", answer.unit.problems},
              {"image", jsonOf(answer.unit.image)},
              {"open", answer.open.names},
              {"openProblem", answer.open.problem},
              {"data", Json::array()}};
    for (const CompiledUnit::Import& import : answer.unit.data)
        json["data"].push_back({import.symbol, import.name, import.module});
    return writeCbor(json);
}

std::optional<UnitAnswer> readUnitAnswer(std::string_view bytes) try {
    const Json json = readCbor(bytes);
    UnitAnswer answer;
    const int verdict = json.at("verdict").get<int>();
    if (verdict < 0 || verdict > static_cast<int>(LoadResult::Verdict::NoCompiler)) return std::nullopt;
    answer.unit.verdict = static_cast<LoadResult::Verdict>(verdict);
    answer.unit.module = json.at("module").get<std::string>();
    answer.unit.problems = json.at("problems").get<std::string>();
    answer.unit.image = imageOf(json.at("image"));
    for (const Json& row : json.at("data"))
        answer.unit.data.push_back(
            {row.at(0).get<std::string>(), row.at(1).get<std::string>(), row.at(2).get<std::string>()});
    answer.open.names = json.at("open").get<std::vector<std::string>>();
    answer.open.problem = json.at("openProblem").get<std::string>();
    return answer;
} catch (const Json::exception&) {
    return std::nullopt;
}

} // namespace rt

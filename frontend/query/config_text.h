#pragma once
// A configuration file (EIO.cfg, SYS.cfg ...) with the places of its words: config/cfg_parser gives values and lines, an editor
// needs ranges. Reads any text; what is not understood is left out.

#include "frontend/query/snapshot.h"

namespace rapid::query {

struct ConfigAttribute {
    std::string name; ///< without the dash
    SourceRange nameRange;
    std::string value;      ///< of the first value, without quotes; empty: given by presence alone
    SourceRange valueRange; ///< between the quotes
};

struct ConfigInstance {
    std::vector<ConfigAttribute> attributes;
    SourceRange range; ///< its lines

    const ConfigAttribute* find(std::string_view name) const;
    std::string text(std::string_view name) const;
};

struct ConfigSection {
    std::string type;  ///< "EIO_SIGNAL"
    SourceRange range; ///< of the type
    uint32_t end = 0;  ///< where the next section begins
    std::vector<ConfigInstance> instances;
};

struct ConfigText {
    std::string domain; ///< "EIO"
    std::vector<ConfigSection> sections;
};

ConfigText readConfigText(std::string_view text);

/// The definition of a signal in one of the files.
struct SignalDefinition {
    std::shared_ptr<const SourceFile> file;
    ConfigInstance instance;
    SourceRange name;
};
/// Of a signal, in any case; without file: no configuration file that is known defines it.
SignalDefinition findSignal(std::span<const std::shared_ptr<const SourceFile>> configuration,
                            std::string_view name);

} // namespace rapid::query

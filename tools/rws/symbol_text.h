#pragma once
// Symbols as entries: their classes and spans; and what a search asks for.

#include "tools/rws/message.h"
#include "tools/service/symbols.h"

#include <optional>
#include <string>
#include <string_view>

namespace rapidc::rws {

/// Class rap-symproppers, rap-sympropvar ...; `suffix`: "" or "-li".
Entry symbolEntry(const service::SymbolInfo& symbol, Dialect dialect, const char* suffix);
/// The short name that fields have: "prc", "fun" ...
std::string_view symtypOf(service::SymbolType type);
/// The fields of a search. None, with what is wrong: they make no sense.
std::optional<service::SymbolQuery> readQuery(const Fields& form, std::string& problem);

} // namespace rapidc::rws

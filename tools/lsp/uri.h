#pragma once
// URIs of documents and paths of files.

#include <optional>
#include <string>
#include <string_view>

namespace lsp {

/// The absolute normal path of a `file:` URI; nothing for other schemes and for what cannot be read.
std::optional<std::string> pathOf(std::string_view uri);
/// The `file:` URI of an absolute path.
std::string fileUri(std::string_view path);

} // namespace lsp

#pragma once
// The documents that the client has open.

#include "tools/lsp/protocol.h"

#include <map>
#include <string>
#include <string_view>

namespace lsp {

struct Document {
    std::string uri;        ///< as the client writes it
    std::string path;       ///< of the file; see Documents::pathFor
    std::string languageId; ///< "rapid"
    int64_t version = 0;
    std::string text; ///< UTF-8
};

class Documents {
  public:
    /// A document of this URI that is open already is replaced.
    Document& open(const std::string& uri, const std::string& languageId, int64_t version, std::string text);
    void close(const std::string& uri);
    /// Null when it is not open.
    Document* find(std::string_view uri);
    Document* byPath(std::string_view path);
    const std::map<std::string, Document, std::less<>>& all() const { return byUri_; }

    /// The path that the workspace knows a document by: that of its file. What is no file, or whose name is none of a RAPID
    /// module while its language is RAPID, gets a path of its own that no file has.
    static std::string pathFor(const std::string& uri, const std::string& languageId);
    /// Whether it is a path that no file has.
    static bool isUnsaved(std::string_view path);
    /// The path of an open document, else that of the file of a URI; "" when it is none.
    std::string pathOfUri(const std::string& uri);
    /// The URI of a path, in the client's own words for open documents.
    std::string uriOf(const std::string& path);

  private:
    std::map<std::string, Document, std::less<>> byUri_;
};

/// Applies one element of contentChanges. Throws RequestError.
void applyChange(Document& document, const Json& change, PositionEncoding encoding);

} // namespace lsp

#include "tools/pendant/page_files.h"

#include <zlib.h>

namespace rapidc::pendant {

std::string plainBytes(const PageFile& file) {
    std::string plain;
    if (!file.isCompressed) return plain.assign(file.bytes);
    z_stream stream{};
    constexpr int kGzip = 16 + MAX_WBITS;
    if (inflateInit2(&stream, kGzip) != Z_OK) return plain;
    // zlib's interface takes no const, but does not write there
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(file.bytes.data()));
    stream.avail_in = static_cast<uInt>(file.bytes.size());
    char part[64 * 1024];
    int status = Z_OK;
    while (status == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(part);
        stream.avail_out = sizeof part;
        status = inflate(&stream, Z_NO_FLUSH);
        plain.append(part, sizeof part - stream.avail_out);
    }
    inflateEnd(&stream);
    return plain;
}

} // namespace rapidc::pendant

#include "tools/pendant/page_files.h"

#include <stdexcept>
#include <zlib.h>

namespace rapidc::pendant {

std::string unpacked(const PageFile& file) {
    if (!file.compressed) return std::string(file.bytes);
    z_stream stream{};
    if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) throw std::runtime_error("zlib cannot start"); // 16: gzip
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(file.bytes.data()));
    stream.avail_in = static_cast<uInt>(file.bytes.size());
    std::string text;
    int status = Z_OK;
    while (status == Z_OK) {
        char piece[16384];
        stream.next_out = reinterpret_cast<Bytef*>(piece);
        stream.avail_out = sizeof piece;
        status = inflate(&stream, Z_NO_FLUSH);
        text.append(piece, sizeof piece - stream.avail_out);
    }
    inflateEnd(&stream);
    if (status != Z_STREAM_END) throw std::runtime_error("a file of the page is damaged");
    return text;
}

} // namespace rapidc::pendant

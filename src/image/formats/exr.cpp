#include "base/printable.h"
#include "image/formats/formats.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfVersion.h>

namespace lfdsim::detail {
namespace {

using Names = std::array<std::string, 3>;
constexpr std::int64_t most_block_rows = 64;         // read at a time: enough for OpenEXR's threads (16 rows a ZIP block)
constexpr std::int64_t most_block_pixels = 1 << 22;  // and at most 48 MiB, unless one row takes more
constexpr int most_tile = 8192;

/// OpenEXR's settings apply to the whole process: its pool of threads, empty at first, and a limit on the tiles that a header may
/// claim.
void start_library() {
    static const bool started = [] {
        // Where the number of threads is limited (engine/devices/threads.h), the calling thread does the work.
        const int allowed = int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
        const int processors = tbb::info::default_concurrency();
        Imf::setGlobalThreadCount(allowed < processors ? 0 : processors);
        Imf::Header::setMaxTileSize(most_tile, most_tile);
        return true;
    }();
    static_cast<void>(started);
}

/// Returns the names of a layer's channels, or for "" those of the picture.
Names channel_names(const std::string& layer) {
    const std::string prefix = layer.empty() ? "" : layer + ".";
    return {prefix + "R", prefix + "G", prefix + "B"};
}

/// The data window or the display window of a file.
struct PixelWindow {
    std::int64_t x0, y0, columns, rows;

    explicit PixelWindow(const Imath::Box2i& box)
        : x0(box.min.x), y0(box.min.y), columns(std::int64_t(box.max.x) - x0 + 1), rows(std::int64_t(box.max.y) - y0 + 1) {}
};

/// Refuses a file that lacks a channel or has fewer samples of it than pixels.
void check_channels(const InputFile& file, const Imf::ChannelList& channels, const Names& names) {
    for (const std::string& name : names) {
        const Imf::Channel* const channel = channels.findChannel(name);
        if (!channel) file.refuse(fmt::format("has no channel {}; {} are needed", name, fmt::join(names, ", ")));
        if (channel->xSampling != 1 || channel->ySampling != 1) file.refuse(fmt::format("has a subsampled channel {}", name));
    }
}

/// Returns the largest number of unpacked bytes for each byte of the file.
double most_packed(Imf::Compression compression) {
    switch (compression) {
        case Imf::NO_COMPRESSION:
            return 1;
        case Imf::RLE_COMPRESSION:
            return 64;  // runs of 128 take two
        case Imf::B44_COMPRESSION:
        case Imf::B44A_COMPRESSION:
            return 32.0 / 3;  // a flat block of 4 x 4 half floats
        case Imf::DWAA_COMPRESSION:
        case Imf::DWAB_COMPRESSION:
            return 1032 * 64;  // of a flat block of 8 x 8 one value is kept, which deflate then packs
        default:
            return 1032;  // the most that deflate packs into a byte; PIZ packs less
    }
}

/// Returns the bytes that a pixel takes unpacked in all of a file's channels.
double pixel_bytes(const Imf::ChannelList& channels) {
    double bytes = 0;
    for (auto c = channels.begin(); c != channels.end(); ++c)
        bytes +=
            (c.channel().type == Imf::HALF ? 2. : 4.) / std::max(1, c.channel().xSampling) / std::max(1, c.channel().ySampling);
    return bytes;
}

/// Refuses windows that are out of proportion to the file.
void check_windows(const InputFile& file, const PixelWindow& data, const PixelWindow& display, const Imf::Header& header) {
    file.check_size(data.columns, data.rows, most_packed(header.compression()) / pixel_bytes(header.channels()));
    // Black parts of the frame take no bytes, so a small file may claim 2^25 pixels (7680 x 4320 are fewer) or 64 times the data.
    // Rows of the data are read whole, so data beyond the frame may be 2^22 pixels or 64 times the frame.
    const double frame = double(display.columns) * double(display.rows), all = double(data.columns) * double(data.rows);
    if (frame >= 0x1p31 || frame > std::max(0x1p25, 64 * all) || all > std::max(0x1p22, 64 * frame))
        file.refuse(fmt::format("is too large: its display window is {} x {} pixels, its data {} x {}; crop the larger one",
                                display.columns, display.rows, data.columns, data.rows));
}

/// Copies the pixels that lie in both windows; outside the data window the picture stays black. Alpha, if there is any, must be 1
/// in the data window.
void read_rows(const InputFile& file, Imf::InputFile& exr, const Names& names, const PixelWindow& data, const PixelWindow& display,
               const Pixels& pixels) {
    // Blocks of rows of the data window, in memory of the frame's rows only.
    constexpr const char* alpha = "A";
    const std::int64_t block_rows = std::clamp(most_block_pixels / data.columns, std::int64_t(1), most_block_rows);
    std::vector<float> block(std::size_t(data.columns * block_rows) * 3), full;
    if (exr.header().channels().findChannel(alpha)) full.resize(std::size_t(data.columns * block_rows));
    const std::int64_t x_begin = std::max(data.x0, display.x0),
                       x_end = std::min(data.x0 + data.columns, display.x0 + display.columns);
    const std::int64_t y_begin = std::max(data.y0, display.y0), y_end = std::min(data.y0 + data.rows, display.y0 + display.rows);
    for (std::int64_t y = y_begin; y < y_end; y += block_rows) {
        const std::int64_t end = std::min(y + block_rows, y_end);
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < 3; ++c)
            frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, block.data() + c, Imath::V2i(int(data.x0), int(y)), data.columns,
                                                    end - y, 3 * sizeof(float), std::size_t(data.columns) * 3 * sizeof(float)));
        if (!full.empty())
            frame.insert(alpha, Imf::Slice::Make(Imf::FLOAT, full.data(), Imath::V2i(int(data.x0), int(y)), data.columns, end - y,
                                                 sizeof(float), std::size_t(data.columns) * sizeof(float)));
        exr.setFrameBuffer(frame);
        exr.readPixels(int(y), int(end - 1));
        for (std::int64_t r = y; r < end; ++r) {
            for (std::int64_t x = x_begin; x < x_end && !full.empty(); ++x)
                if (!(full[std::size_t((r - y) * data.columns + x - data.x0)] >= 1))
                    refuse_transparency(file, x - display.x0, r - display.y0);
            const float* from = &block[std::size_t(((r - y) * data.columns + (x_begin - data.x0)) * 3)];
            float* to = pixels.row(r - display.y0) + (x_begin - display.x0) * pixels.stride;
            for (std::int64_t x = x_begin; x < x_end; ++x, from += 3, to += pixels.stride) std::copy_n(from, 3, to);
        }
        pixels.job->advance(end - y);
    }
}

/// Reads a header byte by byte. The file is refused where it ends within a number or word.
class HeaderBytes {
  public:
    explicit HeaderBytes(const InputFile& file) : file_(file) { go_to(0); }
    std::int32_t number() {
        std::array<unsigned char, 4> b{};
        if (std::fread(b.data(), 1, 4, file_.stream()) != 4) end();
        return std::int32_t(b[0] | b[1] << 8 | b[2] << 16 | std::uint32_t(b[3]) << 24);
    }
    std::string word() {
        std::string text;
        for (int c; (c = std::getc(file_.stream())) != 0; text.push_back(char(c)))
            if (c == EOF || text.size() > 255) end();
        return text;
    }
    std::int64_t at() const { return ftello(file_.stream()); }
    std::int64_t left() const { return file_.size() - at(); }
    void go_to(std::int64_t position) { fseeko(file_.stream(), position, SEEK_SET); }
    void skip(std::int64_t bytes) { go_to(at() + bytes); }

  private:
    [[noreturn]] void end() const { file_.refuse("is damaged or not an EXR file: its header does not end"); }
    const InputFile& file_;
};

/// The sizes in bytes of the types of attributes that have a fixed one.
constexpr std::pair<std::string_view, std::int64_t> attribute_bytes[] = {{"box2f", 16},
                                                                         {"box2i", 16},
                                                                         {"chromaticities", 32},
                                                                         {"compression", 1},
                                                                         {"deepImageState", 1},
                                                                         {"double", 8},
                                                                         {"envmap", 1},
                                                                         {"float", 4},
                                                                         {"int", 4},
                                                                         {"keycode", 28},
                                                                         {"lineOrder", 1},
                                                                         {"m33d", 72},
                                                                         {"m33f", 36},
                                                                         {"m44d", 128},
                                                                         {"m44f", 64},
                                                                         {"rational", 8},
                                                                         {"tiledesc", 9},
                                                                         {"timecode", 8},
                                                                         {"v2d", 16},
                                                                         {"v2f", 8},
                                                                         {"v2i", 8},
                                                                         {"v3d", 24},
                                                                         {"v3f", 12},
                                                                         {"v3i", 12}};

/// Whether an attribute's value, which begins at the next byte, takes exactly the bytes that it claims, and memory in proportion to
/// them. OpenEXR continues where its reading of a value ended, not where the value claims to end; a difference would make it read a
/// size from other bytes, which may be any number.
bool holds_what_it_claims(HeaderBytes& bytes, std::string_view type, std::int64_t size) {
    for (const auto& [name, fixed] : attribute_bytes)
        if (type == name) return size == fixed;
    const std::int64_t end = bytes.at() + size;
    if (type == "floatvector") return size % 4 == 0;
    if (type == "preview") {
        if (size < 8) return false;
        const double columns = bytes.number(), rows = bytes.number();
        return columns >= 0 && rows >= 0 && 4 * columns * rows == double(size - 8);
    }
    if (type == "idmanifest") {
        if (size < 4) return false;
        const std::int64_t unpacked = bytes.number();
        return unpacked >= 0 && unpacked <= 1032 * size;  // deflate packs 1032 bytes into one at best
    }
    if (type == "stringvector") {
        while (end - bytes.at() >= 4)
            if (const std::int64_t text = bytes.number(); text >= 0 && text <= end - bytes.at())
                bytes.skip(text);
            else
                return false;
        return bytes.at() == end;
    }
    if (type == "chlist") {
        while (!bytes.word().empty()) bytes.skip(16);
        return bytes.at() == end;
    }
    return true;  // texts, and values of unknown types, which OpenEXR keeps as bytes
}

/// Refuses attributes that claim more than the file has: OpenEXR allocates what an attribute claims before it reads it.
void check_attributes(const InputFile& file) {
    HeaderBytes bytes(file);
    if (bytes.number() != Imf::MAGIC) file.refuse("is not an EXR file, whatever its name says");
    const bool parts = (bytes.number() & Imf::MULTI_PART_FILE_FLAG) != 0;
    for (bool more = true; more;) {
        std::string name = bytes.word();
        more = parts && !name.empty();  // in a file of several parts an empty header follows the last one
        for (; !name.empty(); name = bytes.word()) {
            const std::string type = bytes.word();
            const std::int64_t size = bytes.number(), value = bytes.at();
            if (size < 0 || size > bytes.left())
                file.refuse(
                    fmt::format("is damaged: its attribute \"{}\" claims {} bytes, more than the file has", shortened(name), size));
            if (!holds_what_it_claims(bytes, type, size))
                file.refuse(
                    fmt::format("is damaged: its attribute \"{}\" is no {} of {} bytes", shortened(name), shortened(type), size));
            bytes.go_to(value + size);
        }
    }
}

/// Returns the number of rows that a compression packs together.
std::int64_t rows_together(Imf::Compression compression) {
    switch (compression) {
        case Imf::NO_COMPRESSION:
        case Imf::RLE_COMPRESSION:
        case Imf::ZIPS_COMPRESSION:
            return 1;
        case Imf::ZIP_COMPRESSION:
        case Imf::PXR24_COMPRESSION:
            return 16;
        case Imf::DWAB_COMPRESSION:
            return 256;
        default:
            return 32;
    }
}

/// Refuses blocks that are out of proportion to the file: the table of blocks has 8 bytes for each, and OpenEXR allocates whole
/// blocks, several at a time. 16 MiB are always allowed.
void check_blocks(const InputFile& file, const Imf::Header& header, const PixelWindow& data) {
    constexpr double usual = 1 << 24;
    std::int64_t columns = data.columns, rows = rows_together(header.compression());
    double blocks = std::ceil(double(data.rows) / double(rows));
    if (header.hasTileDescription()) {
        const Imf::TileDescription& tile = header.tileDescription();
        if (tile.xSize < 1 || tile.ySize < 1 || tile.xSize > most_tile || tile.ySize > most_tile)
            file.refuse(fmt::format("has tiles of {} x {} pixels; allowed are up to {} a side", tile.xSize, tile.ySize, most_tile));
        blocks = std::ceil(double(columns) / tile.xSize) * std::ceil(double(data.rows) / tile.ySize);
        rows = tile.ySize;
    }
    if (blocks * 8 > double(file.size()) ||
        double(columns) * double(rows) * pixel_bytes(header.channels()) > std::max(usual, 1032. * 64 * double(file.size())))
        file.refuse(fmt::format("is damaged: it claims {} x {} pixels, more than its {} bytes can hold", data.columns, data.rows,
                                file.size()));
}

/// Returns the header, after checks that nothing in it is out of proportion to the file. Throws InputError, Iex::BaseExc.
Imf::Header checked_header(const InputFile& file) {
    check_attributes(file);
    Imf::StdIFStream stream(file.name().c_str());
    std::array<char, 8> start{};
    stream.read(start.data(), int(start.size()));
    int version = 0;
    std::memcpy(&version, &start[4], sizeof version);
    Imf::Header header;
    header.readFrom(stream, version);
    const PixelWindow data(header.dataWindow());
    check_windows(file, data, PixelWindow(header.displayWindow()), header);
    check_blocks(file, header, data);
    return header;
}

/// Returns what `work` makes of the header. OpenEXR's errors, those of `work` too, refuse the file.
template <class Work>
auto of_header(const InputFile& file, const Work& work) {
    start_library();
    try {
        return work(checked_header(file));
    } catch (const Iex::BaseExc& error) {
        file.refuse(fmt::format("is damaged or not an EXR file: {}", error.what()));
    }
}

/// Reads three channels. All of them must be there; where they are not `needed`, a file with none of them is left unread.
void read_channels(const InputFile& file, const Names& names, bool needed, const Allocate& allocate) {
    of_header(file, [&](const Imf::Header& header) {
        const Imf::ChannelList& channels = header.channels();
        if (!needed && std::none_of(names.begin(), names.end(), [&](const auto& name) { return channels.findChannel(name); }))
            return;
        check_channels(file, channels, names);
        if (const Imf::Channel* const alpha = channels.findChannel("A"); alpha && (alpha->xSampling != 1 || alpha->ySampling != 1))
            file.refuse("has a subsampled channel A");
        const PixelWindow data(header.dataWindow()), display(header.displayWindow());
        Imf::InputFile exr(file.name().c_str(), Imf::globalThreadCount());
        read_rows(file, exr, names, data, display, allocate(display.columns, display.rows));
    });
}

/// Adds a picture's channels to a header and a frame buffer; the picture must outlive the writing.
void add_channels(const Names& names, const Image& image, Imf::Header& header, Imf::FrameBuffer& frame) {
    for (std::size_t c = 0; c < 3; ++c) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        char* const base = const_cast<char*>(reinterpret_cast<const char*>(image.rgb.data() + c));
        frame.insert(names[c], Imf::Slice(Imf::FLOAT, base, 3 * sizeof(float), std::size_t(image.width) * 3 * sizeof(float)));
    }
}

class OutputStream : public Imf::OStream {
  public:
    explicit OutputStream(Output& file) : Imf::OStream("EXR"), file_(file) {}
    void write(const char bytes[], int count) override { file_.write(bytes, std::size_t(count)); }
    std::uint64_t tellp() override { return std::uint64_t(file_.position()); }
    void seekp(std::uint64_t position) override { file_.seek(std::int64_t(position)); }

  private:
    Output& file_;
};

}  // namespace

void read_exr(const InputFile& file, const Allocate& allocate) { read_channels(file, channel_names(""), true, allocate); }

void read_exr_layer(const InputFile& file, const std::string& layer, const Allocate& allocate) {
    read_channels(file, channel_names(layer), false, allocate);
}

Metadata read_exr_metadata(const InputFile& file) {
    return of_header(file, [](const Imf::Header& header) {
        Metadata metadata;
        for (auto a = header.begin(); a != header.end(); ++a)
            if (const auto* const text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
                metadata[a.name()] = text->value();
        return metadata;
    });
}

StatedColours read_exr_colours(const InputFile& file) {
    return of_header(file, [](const Imf::Header& header) -> StatedColours {
        if (!Imf::hasChromaticities(header)) return {};
        const auto& [red, green, blue, white] = Imf::chromaticities(header);
        return {"chromaticities", are_srgb_primaries({red.x, red.y, green.x, green.y, blue.x, blue.y, white.x, white.y})};
    });
}

void write_exr(Output& file, const Image& image, const WriteOptions& options, Job& job) {
    start_library();
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    add_channels(channel_names(""), image, header, frame);
    for (const ImageLayer& layer : options.layers) add_channels(channel_names(layer.name), layer.image, header, frame);
    for (const auto& [key, value] : options.metadata) header.insert(key, Imf::StringAttribute(value));

    try {
        OutputStream stream(file);
        Imf::OutputFile exr(stream, header, Imf::globalThreadCount());
        exr.setFrameBuffer(frame);
        const int block_rows = 64 * std::max(1, Imf::globalThreadCount());  // four ZIP blocks for each thread
        for (int y = 0; y < image.height; y += block_rows) {
            const int rows = std::min(block_rows, image.height - y);
            exr.writePixels(rows);
            job.advance(rows);
        }
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.name(), error.what()));
    }
}

}  // namespace lfdsim::detail

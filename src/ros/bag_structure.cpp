#include "ros/bag_structure.h"

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <rosbag/exceptions.h>
#include <rosbag/stream.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr char kDefinition = 1, kBagHeader = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7;  // op codes
constexpr size_t kEntry = 12, kTime = 8;  // bytes of an entry of the index: time, offset
constexpr uint32_t kLargestChunk = 1u << 30;  // bytes, unpacked; usually less than a million

struct Damage {
  const char* at;  // where it was noticed
};

uint32_t numberAt(std::string_view bytes, size_t offset) {
  uint32_t number;  // little-endian, as ROS everywhere
  if (bytes.size() < sizeof number || offset > bytes.size() - sizeof number) throw Damage{bytes.data()};
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

// Takes a length, and as many bytes, from the front.
std::string_view takeBlock(std::string_view& bytes) {
  const uint32_t length = numberAt(bytes, 0);
  bytes.remove_prefix(sizeof length);
  if (length > bytes.size()) throw Damage{bytes.data()};
  const std::string_view block = bytes.substr(0, length);
  bytes.remove_prefix(length);
  return block;
}

void checkFields(std::string_view header) {
  while (!header.empty()) takeBlock(header);
}

// Of a record's header, which is blocks of "name=value". Null data: it has none.
std::string_view findField(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const std::string_view field = takeBlock(header);
    if (field.size() > name.size() && field[name.size()] == '=' && field.substr(0, name.size()) == name)
      return field.substr(name.size() + 1);
  }
  return {};
}

std::string_view fieldOf(std::string_view header, std::string_view name) {
  const std::string_view value = findField(header, name);
  if (value.data() == nullptr) throw Damage{header.data()};
  return value;
}

char opOf(std::string_view header) {
  const std::string_view op = fieldOf(header, "op");
  if (op.size() != 1) throw Damage{header.data()};
  return op[0];
}

// What rosbag would make of a chunk. Where it does not fill `size` bytes they are 0xff: no length that is believed.
std::vector<char> unpacked(std::string_view chunk, rosbag::CompressionType compression, uint32_t size) {
  std::vector<char> bytes(size, '\xff');
  std::string packed(chunk);
  try {
    rosbag::StreamFactory(nullptr).getStream(compression)->decompress(
        reinterpret_cast<uint8_t*>(bytes.data()), size, reinterpret_cast<uint8_t*>(packed.data()),
        static_cast<uint32_t>(packed.size()));
  } catch (const rosbag::BagException&) {
    throw Damage{chunk.data()};
  }
  return bytes;
}

// What is read for an entry of the index, as rosbag does it: over what describes connections, up to a message.
void checkMessage(std::string_view bytes) {
  char op;
  uint32_t size;
  do {
    const std::string_view header = takeBlock(bytes);
    checkFields(header);
    op = opOf(header);
    size = numberAt(bytes, 0);
    bytes.remove_prefix(sizeof size);
  } while (op == kConnection || op == kDefinition);
  if (size > bytes.size() && size <= kLargestMessage) throw Damage{bytes.data()};
}

// Every message that the index names lies within the chunk. chunk: unpacked; empty if it is encrypted.
void checkIndex(std::string_view entries, std::string_view chunk, uint32_t chunk_size) {
  for (size_t entry = 0; entry + kEntry <= entries.size(); entry += kEntry) {
    const uint32_t offset = numberAt(entries, entry + kTime);
    if (offset >= chunk_size) throw Damage{entries.data() + entry};
    if (chunk.empty()) continue;
    try {
      checkMessage(chunk.substr(offset));
    } catch (const Damage&) {
      throw Damage{entries.data() + entry};  // the chunk may be elsewhere than in the file
    }
  }
}

uint32_t numberOf(std::string_view header, std::string_view name) { return numberAt(fieldOf(header, name), 0); }

uint64_t placeOf(std::string_view header, std::string_view name) {
  const std::string_view field = fieldOf(header, name);
  return numberAt(field, 0) | static_cast<uint64_t>(numberAt(field, 4)) << 32;
}

// file: from the first byte of the bag.
void checkRecords(std::string_view file) {
  std::string_view bytes = file.substr(kVersion.size()), chunk;
  uint32_t chunk_size = 0;
  bool is_encrypted = false;
  std::vector<char> storage;  // of a chunk that was compressed
  std::set<uint64_t> records, chunks;                        // where they begin
  std::map<uint64_t, const char*> said_records, said_chunks;  // where the bag says that they do, and where it says so
  while (!bytes.empty()) {
    const uint64_t place = bytes.data() - file.data();
    const std::string_view header = takeBlock(bytes), data = takeBlock(bytes);
    checkFields(header);
    records.insert(place);
    switch (opOf(header)) {
      case kBagHeader: {
        said_records[placeOf(header, "index_pos")] = header.data();
        const std::string_view encryptor = findField(header, "encryptor");
        is_encrypted = !encryptor.empty() && encryptor != "rosbag/NoEncryptor";
        break;
      }
      case kChunkInfo: said_chunks[placeOf(header, "chunk_pos")] = header.data(); break;
      case kChunk: {
        chunks.insert(place);
        const std::string_view compression = fieldOf(header, "compression");
        chunk_size = numberOf(header, "size");
        if (chunk_size > kLargestChunk) throw Damage{header.data()};
        if (compression == "none") chunk_size = std::min<size_t>(chunk_size, data.size());
        if (is_encrypted) {
          chunk = {};
        } else if (compression == "bz2" || compression == "lz4") {
          storage = unpacked(data, compression == "bz2" ? rosbag::compression::BZ2 : rosbag::compression::LZ4, chunk_size);
          chunk = {storage.data(), storage.size()};
        } else {
          chunk = data.substr(0, chunk_size);
        }
        break;
      }
      case kIndex:
        if (data.size() / kEntry != numberOf(header, "count")) throw Damage{header.data()};
        checkIndex(data, chunk, chunk_size);
        break;
      case kConnection: checkFields(data); break;
      default: break;
    }
  }
  records.insert(file.size());  // where the index of an empty bag would be
  said_records.erase(0);        // of a bag that was not closed, for which rosbag has a message
  for (const auto& [place, at] : said_records)
    if (records.count(place) == 0) throw Damage{at};
  for (const auto& [place, at] : said_chunks)
    if (chunks.count(place) == 0) throw Damage{at};
}

}  // namespace

void checkBagStructure(const std::string& path) {
  namespace ipc = boost::interprocess;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  try {
    const ipc::file_mapping file(path.c_str(), ipc::read_only);
    const ipc::mapped_region region(file, ipc::read_only);
    const std::string_view bytes(static_cast<const char*>(region.get_address()), region.get_size());
    // Less strict, rosbag would read on.
    if (bytes.substr(0, kVersion.size()) != kVersion)
      throw ConfigurationError("bag " + path, {"is no bag of format 2.0: its first line must be #ROSBAG V2.0, which "
                                               "rosbag has written since 2010"});
    try {
      checkRecords(bytes);
    } catch (const Damage& damage) {
      throw ConfigurationError(
          "bag " + path, {"is cut off or damaged at byte " + std::to_string(damage.at - bytes.data()) + " of " +
                          std::to_string(bytes.size()) + "; rosbag reindex makes of it what can be read"});
    }
  } catch (const ipc::interprocess_exception&) {
    // rosbag says why it cannot be read.
  }
}

}  // namespace live_stiffness

#pragma once
// Damages one message of a bag on the disk.

#include <ros/serialization.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

namespace live_stiffness {

// Makes a bag, which is not compressed, tell `size` bytes as the size of `message`. False if the message is not in it.
template <class Message>
bool damageSize(const std::string& path, const Message& message, uint32_t size) {
  const ros::SerializedMessage bytes = ros::serialization::serializeMessage(message);  // begins with the size, as there
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  const size_t found = all.find(std::string(bytes.buf.get(), bytes.buf.get() + bytes.num_bytes));
  if (found == std::string::npos) return false;
  file.clear();
  file.seekp(static_cast<std::streamoff>(found));
  file.write(reinterpret_cast<const char*>(&size), sizeof size);
  return file.good();
}

}  // namespace live_stiffness

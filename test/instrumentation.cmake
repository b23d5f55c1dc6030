# Builds that look for faults; scripts/test --sanitizer, scripts/fuzz and scripts/coverage choose them.
#   SANITIZER address   AddressSanitizer and UndefinedBehaviorSanitizer
#             thread    ThreadSanitizer
#             fuzzer    as address, and libFuzzer for the targets of test/fuzz; needs clang
#   COVERAGE            gcov counters, gcc
set(SANITIZER "" CACHE STRING "Empty, address, thread or fuzzer")
option(COVERAGE "Count executed lines, for scripts/coverage" OFF)

set(address_options -fsanitize=address,undefined -fno-sanitize-recover=all)
if(SANITIZER STREQUAL "address")
  set(instrumentation ${address_options})
elseif(SANITIZER STREQUAL "thread")
  set(instrumentation -fsanitize=thread)
elseif(SANITIZER STREQUAL "fuzzer")
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "SANITIZER=fuzzer needs clang: -DCMAKE_CXX_COMPILER=clang++")
  endif()
  set(instrumentation ${address_options} -fsanitize=fuzzer-no-link)
elseif(SANITIZER)
  message(FATAL_ERROR "SANITIZER = ${SANITIZER}: must be empty, address, thread or fuzzer")
endif()
if(instrumentation)
  add_compile_options(${instrumentation} -fno-omit-frame-pointer)
  add_link_options(${instrumentation})
endif()
# For the innermost SIMD code, which clang inlines whole: with a check of every pointer it compiles for minutes instead of
# 15 s. AddressSanitizer judges its accesses.
set(light_instrumentation)
if(SANITIZER MATCHES "address|fuzzer" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  set(light_instrumentation -fno-sanitize=alignment,null,object-size,pointer-overflow)
endif()
# No thread is born there, nor does it share anything that its callers do not touch, too: and a rig keeps its pace.
if(SANITIZER STREQUAL "thread")
  set(light_instrumentation -fno-sanitize=thread)
endif()
if(COVERAGE)
  add_compile_options(--coverage -fprofile-update=atomic)
  add_link_options(--coverage)
endif()

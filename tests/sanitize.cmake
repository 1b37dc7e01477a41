# cmake --preset sanitize && cmake --build --preset sanitize && ctest --preset sanitize
#
# Tests once more, with what they test compiled into them under a sanitizer:
#   patina_sanitized_test(NAME address|thread SOURCES file... [LIBRARIES library...] [LEAKS file])
# is the program test-NAME-asan or test-NAME-tsan, the test NAME-asan or NAME-tsan of the label `sanitize`, and a
# part of the target `sanitized`. `address` looks for undefined behaviour, too. Libraries, libtorch and its OpenMP
# among them, are not instrumented: of their own threads and leaks nothing can be said. Leaks are looked for where a
# file of LEAKS names the libraries whose own do not count.
add_custom_target(sanitized)

function(patina_sanitized_test part sanitizer)
  cmake_parse_arguments(TEST "" "LEAKS" "SOURCES;LIBRARIES" ${ARGN})
  if(sanitizer STREQUAL "address")
    set(name ${part}-asan)
    # vptr needs the type information of OpenImageIO's classes, which its library hides.
    set(flags -fsanitize=address,undefined -fno-sanitize-recover=all -fno-sanitize=vptr)
    set(environment ASAN_OPTIONS=detect_leaks=0)
    if(TEST_LEAKS)
      set(environment ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_SOURCE_DIR}/${TEST_LEAKS})
    endif()
  else()
    set(name ${part}-tsan)
    set(flags -fsanitize=thread)
    set(environment TSAN_OPTIONS=ignore_noninstrumented_modules=1)
  endif()
  add_executable(test-${name} ${TEST_SOURCES})
  target_compile_options(test-${name} PRIVATE ${flags} -O1 -g -UNDEBUG)
  target_link_options(test-${name} PRIVATE ${flags})
  target_link_libraries(test-${name} PRIVATE ${TEST_LIBRARIES} Threads::Threads GTest::gtest GTest::gtest_main)
  add_test(NAME ${name} COMMAND test-${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT 900 LABELS sanitize ENVIRONMENT "${environment}")
  add_dependencies(sanitized test-${name})
endfunction()

# With every run of the tests: the parsers of untrusted files, fed with damaged ones; a chain file that two read while
# it is written; what the threads of a run share.
set(engine ${CMAKE_SOURCE_DIR}/engine)
file(GLOB io_sources CONFIGURE_DEPENDS ${engine}/io/*.cpp io_fuzz/*.cpp)
foreach(part checkpoint pickle safetensors_index tensor_index zip_index)  # they do without libtorch
  list(APPEND io_sources ${engine}/summary/${part}.cpp)
endforeach()
patina_sanitized_test(io address
  SOURCES ${io_sources} io/images.cpp io/chain_csv_readers_test.cpp summary/checkpoint_files.cpp
  LIBRARIES nlohmann_json::nlohmann_json PkgConfig::OpenImageIO OpenSSL::Crypto)

file(GLOB thread_sources CONFIGURE_DEPENDS run_tsan/*.cpp ${engine}/io/chain_csv*.cpp)
foreach(part archive finite_evaluation ladder metric natural_spline philox rng step_size_adaptation straightening
             tempering warmup)
  list(APPEND thread_sources ${engine}/sampling/${part}.cpp)
endforeach()
patina_sanitized_test(run thread
  SOURCES ${thread_sources} ${engine}/run/warmup_meeting.cpp ${engine}/io/append_file.cpp ${engine}/io/file.cpp
          ${engine}/io/temporary_folder.cpp io/chain_csv_readers_test.cpp
  LIBRARIES Eigen3::Eigen OpenSSL::Crypto)
set_target_properties(test-run-tsan PROPERTIES UNITY_BUILD OFF)  # of Eigen's templates, as patina_sampling

# With the preset `sanitize`, minutes to compile: whole chains on a cheap density, killed and taken up again, out of
# step, on a full disk.
if(PATINA_SANITIZE)
  file(GLOB chain_sources CONFIGURE_DEPENDS ${engine}/sampling/*.cpp ${engine}/io/chain_csv*.cpp)
  list(FILTER chain_sources EXCLUDE REGEX "(laplace|map_search|sample[^/]*)\\.cpp$")  # no chain needs them
  foreach(part chain chain_checkpoint chain_start run_files state_file state_fits threads warmup_meeting
               warmup_state)
    list(APPEND chain_sources ${engine}/run/${part}.cpp)
  endforeach()
  foreach(sanitizer address thread)
    patina_sanitized_test(chains ${sanitizer}
      SOURCES ${chain_sources} ${engine}/io/append_file.cpp ${engine}/io/file.cpp
              ${engine}/io/temporary_folder.cpp run/resume_test.cpp run/disturbed_chains_test.cpp
      LIBRARIES Eigen3::Eigen lbfgs OpenSSL::Crypto ${TORCH_LIBRARIES} ${CMAKE_DL_LIBS})
  endforeach()
  set_target_properties(test-chains-asan test-chains-tsan PROPERTIES UNITY_BUILD OFF)

  if(PATINA_GUI)
    # The window under random input. The engine below it is as it is.
    file(GLOB window_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/gui/*.cpp ${CMAKE_SOURCE_DIR}/gui/*/*.cpp)
    list(FILTER window_sources EXCLUDE REGEX "gui/(main|window/(glfw_window|explorer|explorer_library))\\.cpp$")
    patina_sanitized_test(gui address LEAKS gui/leaks.supp
      SOURCES ${window_sources} gui/app_random_test.cpp
      LIBRARIES patina_chart patina_comparison patina_run patina_material patina_diagnostics patina_io
                nlohmann_json::nlohmann_json PkgConfig::imgui PkgConfig::freetype2 PkgConfig::osmesa Eigen3::Eigen)
    target_compile_definitions(test-gui-asan PRIVATE PATINA_VERSION="${PROJECT_VERSION}" PATINA_RANDOM_EVENTS=10000)
  endif()
endif()

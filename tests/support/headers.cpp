// Nothing: CMake precompiles headers for a source (lkao_test_headers).

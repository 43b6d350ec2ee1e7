// CMake precompiles headers for the sake of a source that takes them: this one, as test_main.cpp does not.

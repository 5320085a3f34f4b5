# cmake -DREADME=README.md -DPROGRAM=main.cpp -P check_readme.cmake
# The README shows this program, character for character.

file(READ "${README}" readme)
file(READ "${PROGRAM}" program)
string(FIND "${readme}" "```cpp\n${program}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "${README} does not show ${PROGRAM} as it is")
endif()

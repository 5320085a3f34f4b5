# cmake -DNM=<nm> -DPUBLIC_HEADERS=<include/lkao> -DLIBRARIES=a.so,b.so -P check_symbols.cmake
#
# What lkao's shared libraries export is what public headers mark, and of the inner namespaces only what one of the
# libraries calls of another (LKAO_API in lut/). The standard library marks its own templates.

string(REPLACE "," ";" LIBRARIES "${LIBRARIES}")
# Class names and functions marked in public headers.
file(GLOB_RECURSE headers "${PUBLIC_HEADERS}/*.h")
set(public "")
foreach(header IN LISTS headers)
  file(STRINGS "${header}" lines REGEX "LKAO_API [A-Za-z]")
  foreach(line IN LISTS lines)
    if(line MATCHES "^class LKAO_API ([A-Za-z]+)")
      list(APPEND public "${CMAKE_MATCH_1}")
    elseif(line MATCHES "^LKAO_API [^(]*[ *&]([a-z_]+)\\(")
      list(APPEND public "${CMAKE_MATCH_1}")
    endif()
  endforeach()
endforeach()
list(JOIN public "|" public)
set(shared_inside "lut::(check|check_indices|chosen_target|obey_isa_environment|require)")

set(rtti "(typeinfo|typeinfo name|vtable|guard variable)")
set(count 0)
set(wrong "")
foreach(library IN LISTS LIBRARIES)
  execute_process(COMMAND "${NM}" -DC --defined-only "${library}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ";" "," symbols "${symbols}")
  string(REPLACE "\n" ";" symbols "${symbols}")
  foreach(symbol IN LISTS symbols)
    if(NOT symbol MATCHES "^[0-9a-f]+ [A-Za-z] (.*)$")
      continue()
    endif()
    set(name "${CMAKE_MATCH_1}")
    math(EXPR count "${count} + 1")
    if(NOT name MATCHES "^(${rtti} for )?lkao::(gl::)?(${public})(\\(|::|\\[|$)"
       AND NOT name MATCHES "^(${rtti} for )?std::"
       AND NOT name MATCHES "^lkao::${shared_inside}(\\(|$)")
      string(APPEND wrong "\n  ${name}")
    endif()
  endforeach()
endforeach()
if(wrong)
  message(FATAL_ERROR "exported, but not public:${wrong}")
endif()
if(count LESS 60)
  message(FATAL_ERROR "only ${count} symbols are exported")
endif()
message(STATUS "${count} symbols are exported")

# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Writes the words of a SPIR-V file into a C++ header as an array:
# cmake -DINPUT=… -DOUTPUT=… -DNAME=… [-DALL_NAMES=ON] -P EmbedSpirv.cmake
# Of the names (OpName, OpMemberName) only those stay that reflection reads and that tools show for resources: names of
# bindings, of specialisation constants, and of structures with a memory layout and their members. ALL_NAMES keeps all.
cmake_minimum_required(VERSION 3.25)

# Finds the names, which precede the first type, and the ids that keep theirs. gloam_names: items of
# first byte, end byte and id.
set(names "")
set(named_ids "")
set(at 20)  # bytes of the header
file(SIZE ${INPUT} size)
while(at LESS size AND NOT ALL_NAMES)
  file(READ ${INPUT} start OFFSET ${at} LIMIT 16 HEX)
  # SPIR-V is little-endian: opcode, number of words, id, then two more words, of which the first bytes are enough.
  string(REGEX REPLACE "^(..)(..)(..)(..)(........)?(........)?(........)?.*$" "0x\\2\\1;0x\\4\\3;\\5;\\6;\\7" fields "${start}")
  list(GET fields 0 1 2 3 4 fields)
  list(POP_FRONT fields opcode words id second third)
  math(EXPR opcode "${opcode}")
  math(EXPR end "${at} + 4 * ${words}")
  if(opcode GREATER_EQUAL 19 AND opcode LESS_EQUAL 39)
    break()  # the first type
  elseif(opcode EQUAL 5 OR opcode EQUAL 6)
    list(APPEND names "${at} ${end} ${id}")
  elseif(opcode EQUAL 71 AND second MATCHES "^(21|01)000000$")  # OpDecorate Binding, SpecId
    list(APPEND named_ids ${id})
  elseif(opcode EQUAL 72 AND third STREQUAL "23000000")  # OpMemberDecorate Offset
    list(APPEND named_ids ${id})
  endif()
  set(at ${end})
endwhile()

set(bytes "")
set(from 0)
foreach(name IN LISTS names)
  string(REPLACE " " ";" name "${name}")
  list(POP_FRONT name first end id)
  if(NOT id IN_LIST named_ids)
    if(first GREATER from)
      math(EXPR count "${first} - ${from}")
      file(READ ${INPUT} part OFFSET ${from} LIMIT ${count} HEX)
      string(APPEND bytes "${part}")
    endif()
    set(from ${end})
  endif()
endforeach()
file(READ ${INPUT} part OFFSET ${from} HEX)
string(APPEND bytes "${part}")
# The last byte of each four is the most significant.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "#pragma once\nconst uint32_t ${NAME}[] = {${words}};\n")

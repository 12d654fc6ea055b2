# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Writes the words of a SPIR-V file into a C++ header as an array: cmake -DINPUT=… -DOUTPUT=… -DNAME=… -P EmbedSpirv.cmake
file(READ ${INPUT} bytes HEX)
# SPIR-V is little-endian: the last byte of each four is the most significant.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "#pragma once\nconst uint32_t ${NAME}[] = {${words}};\n")

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

/* The distribution's volk comes as source only. */
#include <volk.c>

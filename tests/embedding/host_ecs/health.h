// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

/// A component and a resource that host and plugin share.
struct Health {
  int value = 0;
};
struct Score {
  int healed = 0;
};

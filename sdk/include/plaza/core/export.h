#pragma once

/// Marks a name of the SDK library that plugins and the kernel share. Classes thrown as exceptions
/// or reached by dynamic_cast across libraries need it on both sides, so that their type
/// information is one symbol; everything that is not marked has hidden visibility.
#define PLAZA_API __attribute__((visibility("default")))

// A program of two parts, this file compiled with exceptions and without: what throws in the one does not end the process in the other.
#include "umbilic.hpp"

#include "check.hpp"

void without_exceptions();

#if UMBILIC_EXCEPTIONS
int main() {
  without_exceptions();
  umbilic::status result;
  result.fail(UMB_ERROR_SIZE, "as asked");
  try {
    result.raise();
    CHECK(false);
  } catch (const umbilic::error &error) {
    CHECK(error.status() == UMB_ERROR_SIZE);
  }
  std::puts("mixed: each part its own functions");
  return 0;
}
#else
void without_exceptions() {
  const umbilic::status result;
  result.raise();
}
#endif

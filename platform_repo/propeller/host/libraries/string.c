/* string.h: comparisons of texts, whose values programs may print. The first text that ends gives -1, the second 1, other characters their
 * difference, and a null pointer is less than any text; memcmp gives the difference of two bytes. Sources: propgcc's lib/string. */
#include <ctype.h>
#include <string.h>

static int as_is(int character) { return character; }

static int compared(const char *one, const char *other, size_t most, int limited, int (*taken)(int)) {
  if (!one || !other) return one ? 1 : other ? -1 : 0;
  for (size_t at = 0; !limited || at < most; at++) {
    int mine = taken((unsigned char)one[at]), theirs = taken((unsigned char)other[at]);
    if (mine != theirs) return !mine ? -1 : !theirs ? 1 : mine - theirs;
    if (!mine) return 0;
  }
  return 0;
}

int strcmp(const char *one, const char *other) { return compared(one, other, 0, 0, as_is); }

int strncmp(const char *one, const char *other, size_t most) { return compared(one, other, most, 1, as_is); }

int strcasecmp(const char *one, const char *other) { return compared(one, other, 0, 0, toupper); }

int strncasecmp(const char *one, const char *other, size_t most) { return compared(one, other, most, 1, toupper); }

int memcmp(const void *one, const void *other, size_t size) {
  const unsigned char *mine = one, *theirs = other;
  for (size_t at = 0; at < size; at++)
    if (mine[at] != theirs[at]) return mine[at] - theirs[at];
  return 0;
}

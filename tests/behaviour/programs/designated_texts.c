#include <stdio.h>
#include <string.h>
struct sensor { char name[8];
  int (*read)(struct sensor *);
  int last, history[4];
  unsigned char idx : 2; };
static int rd(struct sensor *s) { return s->last += 30000; }
static struct sensor sensors[] = { { "left", rd }, { .name = "right", .read = rd, .last = 5 } };
#define EACH(s) for (struct sensor *s = sensors; s < sensors + sizeof sensors / sizeof *sensors; s++)
void record(struct sensor *s, int v) { s->history[s->idx++] = v; }
static const char *const fmt = "%s: %d %d\n";
char *itoa_(int v, char *b) { char *p = b + 11;
  *p = 0;
  unsigned u = v < 0 ? -v : v;
  do *--p = '0' + u % 10;
  while (u /= 10);
  if (v < 0) *--p = '-';
  return p; }
unsigned long checksum(const void *p, size_t n) { const unsigned char *c = p;
  unsigned long s = 1;
  while (n--) s = s * 31 + *c++;
  return s; }
int clamp(int v, int lo, int hi) { return v < lo ? lo : v > hi ? hi : v; }
int lerp(int a, int b, int t) { return a + (b - a) * t / 1000; }
int main() { for (int r = 0; r < 5; r++) EACH(s) record(s, s->read(s));
  EACH(s) printf(fmt, s->name, s->history[0], s->history[3]);
  char b[12];
  printf("%s %s\n", itoa_(-123456, b), itoa_(0, b));
  printf("%lu\n", checksum("robot", 5));
  printf("%d %d\n", clamp(70000, -5, 40000), lerp(0, 100000, 333));
  return 0; }

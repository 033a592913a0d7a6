#include "simpletext.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
typedef text_t wire;
struct state { char seen[40]; int count, next; };
static short table[4];
int wire_tx(wire *w, int c)
{
  struct state *s = (struct state *)w->devst;
  if (s->count < 39) s->seen[s->count++] = c + table[0];
  return c;
}
int wire_rx(wire *w) { struct state *s = (struct state *) w->devst; return "xyz"[s->next++ % 3]; }
wire *wire_open(int cog)
{
  wire *w = malloc(sizeof(wire));
  memset(w, 0, sizeof(wire));
  w->devst = malloc(sizeof(struct state));
  memset((void *)w->devst, 0, sizeof(struct state));
  w->txChar = wire_tx;
  w->rxChar = wire_rx;
  w->cogid[0] = cog;
  w->terminalEcho = 1;
  return w;
}
static short table[] = { 1, 2, 3, 4 };
int main()
{
  wire *w = wire_open(40000);
  struct state *s = (struct state *)w->devst;
  writeStr(w, "HAL");
  writeDec(w, -70000);
  printf("%s %d\n", s->seen, s->count);
  printf("%c%c\n", readChar(w), w->rxChar(w));
  printf("%d %d\n", w->cogid[0] + 1, w->terminalEcho);
  return 0;
}

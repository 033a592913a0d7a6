#include "simpletools.h"
#include <stdlib.h>

enum mode { OFF, ON };
struct item { int n; struct item *next; };

enum mode current = 0;
char *title = "robot";
unsigned char levels[] = {0, 128, 255};

struct item *make(int n)
{
  struct item *made = malloc(sizeof(struct item));
  made->n = n;
  made->next = 0;
  return made;
}

void take(char *text, enum mode m) { current = m; title = text; }

int main()
{
  int address = &levels[1];
  int *raw = calloc(4, sizeof(int));
  void *any = raw;
  struct item *list = make(1);
  take("text", 1);
  raw = any;
  current = address ? ON : 0;
  while (1) {
    list->next = make(list->n + 1);
    free(raw);
    pause(levels[0]);
  }
}

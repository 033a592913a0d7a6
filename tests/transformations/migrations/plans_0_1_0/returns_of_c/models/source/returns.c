#include "simpletools.h"

int level;
int measure(int n) { if (n) return; return 5; }
void store(int n) { if (n > 2) return level = n; }
void show(void) { return store(3); }
int ask(int n) { if (n) return 1; else return 0; }
int wait_for(int n) { while (1) { if (input(n)) return n; } }
int last(int n) { switch (n) { case 1: return 2; } }

int main()
{
  while (1) {
    measure(1);
    show();
    pause(level + ask(1) + wait_for(2) + last(1));
  }
}

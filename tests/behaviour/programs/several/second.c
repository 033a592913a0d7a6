#include <stdio.h>
#include "parts.h"
static int count;
static int helper(int n) { count += n; return count; }
int list[3] = { 1, 70000, 3 };
const char *names[2] = { "a", "b" };
int common;
extern int shared;
int second(int n) { helper(n); return helper(n) + AREA; }
void show(void) { printf("%d %d\n", shared, common); }

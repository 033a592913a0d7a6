#include "parts.h"
static int count = 60000;
static int helper(int n) { return n * count; }
int shared = 40000;
int first(int n) { return helper(n); }
struct box box = { 70000, 2 };
int undeclared_later(int v) { return v + AREA; }

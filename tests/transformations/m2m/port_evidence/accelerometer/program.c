#include "simpletools.h"
#include "lis3dh.h"
int main() { lis3dh *a = lis3dh_init(8, 7, 6); (void) a; }

#include "simpletools.h"  // the library
/* before main */
int main() /* between */
{ /* opening */
  /* own line */ high(1); /* behind high */
  /* before the loop */
  while /* in the head */ (1) /* behind the head */
  { // opening of the loop
    low(1); // behind low
    /* last in the loop */
  } // closing of the loop
  /* last in main */
} /* closing */
// behind main

/* A library of somebody's own: a mast with two lamps. */
#ifndef SIGNAL_MAST_H
#define SIGNAL_MAST_H
#define MAST_LAMPS 2
int mast_show(int lamp, int on);
#endif

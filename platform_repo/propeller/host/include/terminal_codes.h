/* Control characters of the terminal, which several headers name. A program's own definition goes before. */
#ifndef HOME
#define HOME (1)
#endif
#ifndef CRSRXY
#define CRSRXY (2)
#endif
#ifndef CRSRLF
#define CRSRLF (3)
#endif
#ifndef CRSRRT
#define CRSRRT (4)
#endif
#ifndef CRSRUP
#define CRSRUP (5)
#endif
#ifndef CRSRDN
#define CRSRDN (6)
#endif
#ifndef BEEP
#define BEEP (7)
#endif
#ifndef BKSP
#define BKSP (8)
#endif
#ifndef TAB
#define TAB (9)
#endif
#ifndef NL
#define NL (10)
#endif
#ifndef LF
#define LF (10)
#endif
#ifndef CLREOL
#define CLREOL (11)
#endif
#ifndef CLRDN
#define CLRDN (12)
#endif
#ifndef CR
#define CR (13)
#endif
#ifndef CRSRX
#define CRSRX (14)
#endif
#ifndef CRSRY
#define CRSRY (15)
#endif
#ifndef CLS
#define CLS (16)
#endif

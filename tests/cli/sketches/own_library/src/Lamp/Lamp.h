#pragma once
void lamp_on(void);

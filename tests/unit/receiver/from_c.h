#pragma once

#ifdef __cplusplus
extern "C" {
#endif

int frames_a_c_program_finds_foreign(void);

#ifdef __cplusplus
}
#endif

// How many threads the system lets this process have. Floor 2.
#pragma once

namespace lfdsim {

/// Returns the number of threads that can be started now besides the calling one, at most `wanted`. It starts them to find out,
/// because limits on processes, groups of processes and address space all count.
int threads_to_be_had(int wanted);

/// Limits work to as many threads as there can be: libraries wait without end, or give up, for one that the system refuses. Where
/// there are enough nothing changes; where there are none the calling thread does all the work.
void use_only_threads_to_be_had();

/// Returns the number of threads that work for `wanted` ones, 0 meaning one per processor, runs on.
int threads_used(int wanted);

}  // namespace lfdsim

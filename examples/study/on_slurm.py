#!/usr/bin/env python3
"""A study on workers that Slurm starts: on_slurm.py STUDY.toml FOLDER JOBS. The folder is on a file system that all nodes see.

dask-jobqueue has the same class for PBS, LSF, SGE, HTCondor and OAR; its documentation lists what a site may need (account, queue, memory).
"""

import sys

import dask_jobqueue
import distributed

import lfdsim.study


def main(study: str, folder: str, jobs: int) -> None:
    # A job is one worker with one core here. Larger jobs suit sites that give whole nodes: cores=32, processes=32.
    cluster = dask_jobqueue.SLURMCluster(cores=1, processes=1, memory="2GB", walltime="04:00:00")
    cluster.scale(jobs=jobs)
    with distributed.Client(cluster) as client:
        print(lfdsim.study.run(study, folder, dask=client))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]))

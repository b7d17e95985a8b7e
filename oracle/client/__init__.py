"""What an implementation answers, whatever it does: each failure is pinned on its own question.

apart        our processes, kept from the files of their user
process      one live program: lines in, lines out, and no deadlock
descendants  whom a client has started, found and ended wherever they went
dialogue     questions to a target, answers in order; a program that speaks the line protocol
inprocess    code that is loaded into a process of ours, and how questions travel there
worker       what runs in that process: code loaded, called and understood
target       what the words of a target mean
declared     a target of which a file declares other things than it says
replay       a run over many questions, and what is asked again after a failure
misread      what an adapter answers that misreads a question
smoke        easy cases, and which of them fail
adapter      what is wrong with the adapter, and what to do, for programs, functions, libraries
"""

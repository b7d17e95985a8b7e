"""Answers everything."""

from wire import reply, say, serve

serve(lambda question: say(reply(question)))

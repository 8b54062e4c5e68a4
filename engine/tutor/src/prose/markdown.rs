//! Markdown becomes blocks.

use pulldown_cmark::{Event, Parser, Tag, TagEnd};

use super::template::{Filled, Value};
use super::{Block, Inline, plain};

/// The blocks of prose whose templates are filled.
pub fn blocks(filled: &Filled) -> Vec<Block> {
    let mut writer = Writer {
        filled,
        blocks: Vec::new(),
        inlines: Vec::new(),
        lists: Vec::new(),
        strong: 0,
        emph: 0,
        quote: 0,
        code: None,
    };
    for event in Parser::new(&filled.text) {
        writer.event(event);
    }
    writer.flush();
    writer.blocks
}

struct Writer<'a> {
    filled: &'a Filled,
    blocks: Vec<Block>,
    /// The paragraph or item being written.
    inlines: Vec<Inline>,
    /// Open lists, outermost first; inner lists become further items of the outermost.
    lists: Vec<(Option<u64>, Vec<Vec<Inline>>)>,
    strong: usize,
    emph: usize,
    quote: usize,
    /// The code block being written.
    code: Option<String>,
}

impl Writer<'_> {
    fn event(&mut self, event: Event<'_>) {
        match event {
            Event::Start(tag) => self.start(&tag),
            Event::End(tag) => self.end(tag),
            Event::Text(text) | Event::Html(text) | Event::InlineHtml(text) => self.text(&text),
            Event::Code(code) => {
                let code = self.filled_in(&code);
                self.inlines.push(Inline::Code(code));
            }
            Event::SoftBreak => self.text(" "),
            Event::HardBreak => self.text("\n"),
            // The extensions that would make the others are off.
            _ => {}
        }
    }

    fn start(&mut self, tag: &Tag<'_>) {
        match tag {
            Tag::Strong => self.strong += 1,
            Tag::Emphasis => self.emph += 1,
            Tag::BlockQuote(_) => {
                self.flush();
                self.quote += 1;
            }
            Tag::CodeBlock(_) => {
                self.flush();
                self.code = Some(String::new());
            }
            Tag::List(first) => {
                self.end_item();
                self.lists.push((*first, Vec::new()));
            }
            // A further paragraph of an item goes on in the same item.
            Tag::Paragraph if !self.lists.is_empty() && !self.inlines.is_empty() => self.text(" "),
            Tag::Paragraph | Tag::Heading { .. } | Tag::HtmlBlock => self.flush(),
            _ => {}
        }
    }

    fn end(&mut self, tag: TagEnd) {
        match tag {
            TagEnd::Strong => self.strong = self.strong.saturating_sub(1),
            TagEnd::Emphasis => self.emph = self.emph.saturating_sub(1),
            TagEnd::BlockQuote(_) => {
                self.flush();
                self.quote = self.quote.saturating_sub(1);
            }
            TagEnd::CodeBlock => {
                if let Some(code) = self.code.take() {
                    self.blocks
                        .push(Block::CodeBlock(code.trim_end_matches('\n').to_owned()));
                }
            }
            TagEnd::Item => self.end_item(),
            TagEnd::List(_) => self.end_list(),
            TagEnd::Heading(_) => {
                let words = plain(&std::mem::take(&mut self.inlines));
                self.blocks.push(Block::Heading(words));
            }
            TagEnd::Paragraph if self.lists.is_empty() => self.flush(),
            _ => {}
        }
    }

    fn end_item(&mut self) {
        if let Some((_, items)) = self.lists.last_mut()
            && !self.inlines.is_empty()
        {
            items.push(std::mem::take(&mut self.inlines));
        }
    }

    fn end_list(&mut self) {
        self.end_item();
        let Some((first, items)) = self.lists.pop() else {
            return;
        };
        match (self.lists.last_mut(), first) {
            (Some((_, outer)), _) => outer.extend(items),
            // "2. What would you see?" is a numbered question, not a list of one.
            (None, Some(first)) if first != 1 || items.len() == 1 => {
                for (number, mut item) in (first..).zip(items) {
                    item.insert(0, Inline::Text(format!("{number}. ")));
                    self.blocks.push(Block::Paragraph(item));
                }
            }
            (None, first) => self.blocks.push(Block::List {
                ordered: first.is_some(),
                items,
            }),
        }
    }

    /// Ends the paragraph being written.
    fn flush(&mut self) {
        if !self.lists.is_empty() {
            return;
        }
        let inlines = std::mem::take(&mut self.inlines);
        if inlines.is_empty() {
            return;
        }
        self.blocks.push(if self.quote > 0 {
            Block::Quote(inlines)
        } else {
            Block::Paragraph(inlines)
        });
    }

    fn filled_in(&self, text: &str) -> String {
        let mut out = String::with_capacity(text.len());
        for character in text.chars() {
            match self.filled.value(character) {
                Some(Value::Text(value) | Value::Math(value)) => out.push_str(value),
                None => out.push(character),
            }
        }
        out
    }

    fn text(&mut self, text: &str) {
        if let Some(mut code) = self.code.take() {
            code.push_str(&self.filled_in(text));
            self.code = Some(code);
            return;
        }
        let mut words = String::new();
        for character in text.chars() {
            match self.filled.value(character) {
                Some(Value::Math(value)) => {
                    let value = value.clone();
                    self.words(std::mem::take(&mut words));
                    self.inlines.push(Inline::Math(value));
                }
                Some(Value::Text(value)) => words.push_str(value),
                None => words.push(character),
            }
        }
        self.words(words);
    }

    /// Adds words in the style that is on, to the last inline where the style is the same.
    fn words(&mut self, words: String) {
        if words.is_empty() {
            return;
        }
        let (strong, emph) = (self.strong > 0, self.emph > 0);
        match self.inlines.last_mut() {
            Some(Inline::Strong(text)) if strong => text.push_str(&words),
            Some(Inline::Emph(text)) if emph && !strong => text.push_str(&words),
            Some(Inline::Text(text)) if !strong && !emph => text.push_str(&words),
            _ if strong => self.inlines.push(Inline::Strong(words)),
            _ if emph => self.inlines.push(Inline::Emph(words)),
            _ => self.inlines.push(Inline::Text(words)),
        }
    }
}
